#include "app/settings.h"

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/text.h"

namespace seascape {

namespace {

template <class... F>
struct Visitor : F... {
  using F::operator()...;
};
template <class... F>
Visitor(F...) -> Visitor<F...>;

// Members are reached through Settings&; reading does not change anything.
Settings& mutable_settings(const Settings& settings) { return const_cast<Settings&>(settings); }

constexpr std::size_t longest_text = 400;

bool is_flag(const Setting& setting) { return std::holds_alternative<FlagMember>(setting.member); }
bool is_choice(const Setting& setting) { return std::holds_alternative<ChoiceMember>(setting.member); }
bool is_text(const Setting& setting) { return std::holds_alternative<TextMember>(setting.member); }
bool is_whole(const Setting& setting) {
  return std::holds_alternative<IntegerMember>(setting.member) || std::holds_alternative<SeedMember>(setting.member);
}

std::string text_of(const SettingValue& value) {
  return std::visit(
      Visitor{[](bool flag) { return std::string(flag ? "true" : "false"); },
              [](double number) { return std::isfinite(number) ? text_from(number) : "not a finite number"; },
              [](const std::string& name) { return in_quotes(name); }},
      value);
}

std::string remedy_for(const Setting& setting) {
  if (is_flag(setting)) return "give true or false";
  if (is_text(setting))
    return "give a text of at most " + std::to_string(longest_text) + " bytes without control characters";
  if (!setting.choices.empty()) return "give " + range_text(setting);
  return std::string(is_whole(setting) ? "give a whole number from " : "give a number from ") + range_text(setting);
}

}  // namespace

const Setting* find_setting(std::string_view key) {
  for (const Setting& setting : settings_table())
    if (setting.key == key) return &setting;
  return nullptr;
}

bool same_group(const Settings& a, const Settings& b, std::string_view group) {
  const auto rows = settings_table();
  return std::all_of(rows.begin(), rows.end(), [&](const Setting& row) {
    return row.key.substr(0, row.key.find('.')) != group || value_of(a, row) == value_of(b, row);
  });
}

SettingValue value_of(const Settings& constant, const Setting& setting) {
  Settings& settings = mutable_settings(constant);
  return std::visit(
      Visitor{[&](RealMember member) { return SettingValue(member(settings)); },
              [&](IntegerMember member) { return SettingValue(static_cast<double>(member(settings))); },
              [&](SeedMember member) { return SettingValue(static_cast<double>(member(settings))); },
              [&](FlagMember member) { return SettingValue(member(settings)); },
              [&](TextMember member) { return SettingValue(member(settings)); },
              [&](const ChoiceMember& member) {
                return SettingValue(std::string(setting.choices.at(static_cast<std::size_t>(member.get(settings)))));
              }},
      setting.member);
}

std::string value_text(const Settings& settings, const Setting& setting) {
  const SettingValue value = value_of(settings, setting);
  if (const auto* name = std::get_if<std::string>(&value)) return *name;
  return text_of(value);
}

std::string range_text(const Setting& setting) {
  if (is_flag(setting)) return "true or false";
  if (is_text(setting)) return "text";
  if (!setting.choices.empty()) return listed(setting.choices);
  return text_from(setting.least) + " to " + text_from(setting.most) +
         (setting.unit.empty() ? "" : " " + std::string(setting.unit));
}

void set_value(Settings& settings, const Setting& setting, const SettingValue& value, const std::string& where,
               int exit_code) {
  const auto refuse = [&](const std::string& why) {
    throw Error(where, std::string(setting.key) + ": " + text_of(value) + " " + why, remedy_for(setting), exit_code);
  };
  if (is_flag(setting)) {
    const bool* flag = std::get_if<bool>(&value);
    if (flag == nullptr) refuse("is neither true nor false");
    std::get<FlagMember>(setting.member)(settings) = *flag;
    return;
  }
  if (is_text(setting)) {
    const auto* text = std::get_if<std::string>(&value);
    if (text == nullptr) refuse("is no text");
    if (text->size() > longest_text ||
        std::any_of(text->begin(), text->end(), [](char c) { return static_cast<unsigned char>(c) < 32; }))
      refuse("is too long or has control characters");
    std::get<TextMember>(setting.member)(settings) = *text;
    return;
  }
  if (is_choice(setting)) {
    const auto* name = std::get_if<std::string>(&value);
    const auto found =
        name == nullptr ? setting.choices.end() : std::find(setting.choices.begin(), setting.choices.end(), *name);
    if (found == setting.choices.end()) refuse("is none of its names");
    std::get<ChoiceMember>(setting.member).set(settings, static_cast<int>(found - setting.choices.begin()));
    return;
  }
  const double* number = std::get_if<double>(&value);
  if (number == nullptr) refuse("is not a number");
  if (!std::isfinite(*number) || *number < setting.least || *number > setting.most) refuse("is out of range");
  if (is_whole(setting) && *number != std::floor(*number)) refuse("is not a whole number");
  if (!setting.choices.empty() &&
      std::find(setting.choices.begin(), setting.choices.end(), text_from(*number)) == setting.choices.end())
    refuse("is not one of the numbers it takes");
  std::visit(Visitor{[&](RealMember member) { member(settings) = *number; },
                     [&](IntegerMember member) { member(settings) = static_cast<int>(*number); },
                     [&](SeedMember member) { member(settings) = static_cast<std::uint32_t>(*number); },
                     [](FlagMember) {}, [](TextMember) {}, [](const ChoiceMember&) {}},
             setting.member);
}

void set_from_text(Settings& settings, std::string_view key, std::string_view value, const std::string& where,
                   int exit_code) {
  const Setting* setting = find_setting(key);
  if (setting == nullptr) throw_unknown_key(key, where, exit_code);
  SettingValue parsed = std::string(value);
  if (is_flag(*setting) && (value == "true" || value == "false")) {
    parsed = value == "true";
  } else if (!is_flag(*setting) && !is_choice(*setting) && !is_text(*setting)) {
    if (const auto number = real_from(value)) parsed = *number;
  }
  set_value(settings, *setting, parsed, where, exit_code);
}

void throw_unknown_key(std::string_view key, const std::string& where, int exit_code) {
  std::vector<std::string_view> keys;
  for (const Setting& setting : settings_table()) keys.push_back(setting.key);
  throw Error(where, "unknown key " + in_quotes(key) + did_you_mean(key, keys),
              "remove it, or take a key of docs/settings.md", exit_code);
}

}  // namespace seascape
