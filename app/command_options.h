// One command's options, on CLI11.
#pragma once
#include <CLI/CLI.hpp>
#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/error.h"
#include "engine/text.h"

namespace seascape {

// Wrong usage of an option: exit code 2.
[[noreturn]] inline void refuse(const std::string& option, const std::string& what, const std::string& remedy) {
  throw Error(option, what, remedy, 2);
}

// Values are read by our own parsers, so that numbers do not depend on the locale and every fault
// names option, value and range.
class Options {
 public:
  Options(std::string_view command, const std::string& sentence, const std::string& examples)
      : app_(sentence, "seascape " + std::string(command)) {
    app_.footer("Examples:\n" + examples);
    app_.get_formatter()->column_width(36);
    app_.allow_extras();
  }

  template <class Take>
  CLI::Option* option(const std::string& name, const std::string& type, const std::string& fallback,
                      const std::string& sentence, Take take) {
    names_.push_back(name);
    return app_
        .add_option_function<std::string>(
            name, [take](const std::string& text) { take(text); }, sentence)
        ->type_name(type)
        ->default_str(fallback);
  }

  void text(const std::string& name, const std::string& type, std::string& value, const std::string& sentence) {
    option(name, type, value, sentence, [name, &value](const std::string& given) {
      if (given.empty()) refuse(name, "the value is empty", "leave " + name + " out or give it one");
      value = given;
    });
  }

  void number(const std::string& name, const std::string& unit, double& value, double least, double most,
              const std::string& sentence) {
    const std::string range = text_from(least) + " to " + text_from(most) + (unit.empty() ? "" : " " + unit);
    option(name, "NUMBER", text_from(value), sentence + " (" + range + ")", [=, &value](const std::string& given) {
      const auto number = real_from(given);
      if (!number || *number < least || *number > most)
        refuse(name, in_quotes(given) + (number ? " is out of range" : " is not a number"),
               "give a number from " + range);
      value = *number;
    });
  }

  void whole(const std::string& name, int& value, int least, int most, const std::string& sentence) {
    const std::string range = std::to_string(least) + " to " + std::to_string(most);
    option(name, "N", std::to_string(value), sentence + " (" + range + ")", [=, &value](const std::string& given) {
      const auto number = integer_from(given);
      if (!number || *number < least || *number > most)
        refuse(name, in_quotes(given) + (number ? " is out of range" : " is not a whole number"),
               "give a whole number from " + range);
      value = static_cast<int>(*number);
    });
  }

  // One of `names`; `take` gets its index.
  template <class Take>
  void choice(const std::string& name, std::vector<std::string_view> names, const std::string& fallback,
              const std::string& sentence, Take take) {
    std::string type;
    for (const std::string_view one : names) type += (type.empty() ? "" : "|") + std::string(one);
    option(name, type, fallback, sentence, [=](const std::string& given) {
      for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == given) return take(static_cast<int>(i));
      refuse(name, "unknown value " + in_quotes(given) + did_you_mean(given, names), "take " + listed(names));
    });
  }

  void flag(const std::string& name, bool& value, const std::string& sentence) {
    names_.push_back(name);
    flags_.push_back(name);
    app_.add_flag_callback(
        name, [&value] { value = true; }, sentence);
  }

  CLI::App& app() { return app_; }

  // Returns the help text where it was asked for, else "".
  std::string parse(std::span<const std::string> words) {
    for (const std::string& word : words) {  // CLI11 would take the next word for its value, and some for a flag's
      if (word == "--") break;
      const std::string name = word.substr(0, word.find('='));
      if (word.starts_with("--") && word.find('=') == word.size() - 1)
        refuse(word.substr(0, word.size() - 1), "no value follows " + in_quotes(word),
               "leave " + word.substr(0, word.size() - 1) + " out or give it a value");
      if (name.size() < word.size() && std::find(flags_.begin(), flags_.end(), name) != flags_.end())
        refuse(name, "takes no value", "write " + name + " alone");
    }
    try {
      app_.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    } catch (const CLI::CallForHelp&) {
      return app_.help();
    } catch (const CLI::ArgumentMismatch& fault) {
      const std::string text = fault.what(), name = text.substr(0, text.find(':'));
      if (text.find("missing") == std::string::npos) refuse(name, "is given more than once", "give it once");
      refuse(name, "no value follows it", "leave " + name + " out or give it a value");
    } catch (const CLI::ParseError& fault) {
      refuse("", one_line(fault.what(), 200), "see " + app_.get_name() + " --help");
    }
    for (const std::string& word : app_.remaining()) {
      const bool is_option = word.size() > 1 && word[0] == '-';
      const std::vector<std::string_view> known(names_.begin(), names_.end());
      refuse("",
             (is_option ? "unknown option " : "unexpected word ") + in_quotes(word) +
                 (is_option ? did_you_mean(word.substr(0, word.find('=')), known) : ""),
             "see " + app_.get_name() + " --help");
    }
    return {};
  }

 private:
  CLI::App app_;
  std::vector<std::string> names_{"--help", "--set"}, flags_{"--help"};
};

}  // namespace seascape
