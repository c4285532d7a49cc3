#include "app/located_json.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "engine/text.h"

namespace seascape {

namespace {

// Where the parser has read to. It reads one character past a number, and nothing past any other token.
struct Place {
  int line = 1;
  bool after_newline = false;  // the last character read ended a line
  int line_of_number() const { return after_newline ? line - 1 : line; }
};

class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, Place* place) : at_(at), place_(place) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    place_->after_newline = *at_ == '\n';
    if (place_->after_newline) ++place_->line;
    ++at_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  Place* place_;
};

// Builds the tree from the parser's events. Members take their key's line.
class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  using Kind = LocatedJson::Kind;

  Builder(const Place& place, const std::string& where) : place_(place), where_(where) {}

  LocatedJson take() { return std::move(root_); }

  bool null() override { return attach(made(Kind::null, place_.line)); }
  bool boolean(bool value) override {
    LocatedJson json = made(Kind::flag, place_.line);
    json.flag = value;
    return attach(std::move(json));
  }
  bool number_integer(number_integer_t value) override { return number(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool string(string_t& value) override {
    LocatedJson json = made(Kind::text, place_.line);
    json.text = std::move(value);
    return attach(std::move(json));
  }
  bool binary(binary_t&) override { return true; }  // never in text
  bool start_object(std::size_t) override { return open(Kind::object); }
  bool start_array(std::size_t) override { return open(Kind::array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Open& parent = open_.back();
    if (const LocatedJson* first = parent.json.member(name))
      throw Error(at(place_.line),
                  "the key " + in_quotes(name) + " is given twice, first on line " + std::to_string(first->line),
                  "remove one of the two");
    // Looking for a key given twice takes time by the square of their number; no object of ours has more than some
    // dozens.
    if (parent.json.items.size() >= 1000)
      throw Error(at(place_.line), "an object with more than 1000 keys", "remove what does not belong there");
    parent.key = std::move(name);
    parent.key_line = place_.line;
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& fault) override {
    // "[json.exception.parse_error.101] parse error at line 3, column 5: syntax error while ...": we name the place.
    std::string what = fault.what();
    if (const auto end = what.find("] "); end != std::string::npos) what.erase(0, end + 2);
    if (what.rfind("parse error at line ", 0) == 0)
      if (const auto end = what.find(": "); end != std::string::npos) what.erase(0, end + 2);
    throw Error(at(place_.line_of_number()), "not valid JSON: " + one_line(what, 200),
                "mend the text there; JSON has no comments and no comma after the last item");
  }

 private:
  struct Open {
    LocatedJson json;
    std::string key;  // of the member to come
    int key_line = 1;
  };

  std::string at(int line) const { return where_ + ":" + std::to_string(line); }

  LocatedJson made(Kind kind, int line) {
    if (++values_ > most_json_values)
      throw Error(at(line), "more than " + std::to_string(most_json_values) + " values", "give a smaller file");
    LocatedJson json;
    json.kind = kind;
    json.line = line;
    return json;
  }

  bool number(double value) {
    LocatedJson json = made(Kind::number, place_.line_of_number());
    json.number = value;
    return attach(std::move(json));
  }

  bool attach(LocatedJson json) {
    if (open_.empty()) {
      root_ = std::move(json);
      return true;
    }
    Open& parent = open_.back();
    if (parent.json.is(Kind::object)) {
      json.key = std::move(parent.key);
      json.line = parent.key_line;
    }
    parent.json.items.push_back(std::move(json));
    return true;
  }

  bool open(Kind kind) {
    if (open_.size() >= deepest_json)
      throw Error(at(place_.line), "nested deeper than " + std::to_string(deepest_json) + " levels",
                  "flatten the file");
    Open opened;
    opened.json = made(kind, place_.line);
    open_.push_back(std::move(opened));
    return true;
  }

  bool close() {
    LocatedJson done = std::move(open_.back().json);
    open_.pop_back();
    return attach(std::move(done));
  }

  const Place& place_;
  const std::string& where_;
  std::vector<Open> open_;
  std::size_t values_ = 0;
  LocatedJson root_;
};

}  // namespace

const LocatedJson* LocatedJson::member(std::string_view name) const {
  for (const LocatedJson& item : items)
    if (item.key == name && is(Kind::object)) return &item;
  return nullptr;
}

LocatedJson parse_located_json(std::string_view text, const std::string& where) {
  if (text.size() > largest_json_bytes)
    throw Error(where, "the file has " + std::to_string(text.size()) + " bytes", "give a file of at most 16 MiB");
  // The parser would take a zero byte for the end, and pass over what follows.
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos)
    throw Error(where + ":" + std::to_string(1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(zero), '\n')),
                "a zero byte where text should be", "save the file as UTF-8 text, without what follows its end");
  Place place;
  Builder builder(place, where);
  nlohmann::json::sax_parse(CountingIterator(text.data(), &place), CountingIterator(text.data() + text.size(), &place),
                            &builder);
  return builder.take();
}

std::string described(const LocatedJson& json) {
  switch (json.kind) {
    case LocatedJson::Kind::null:
      return "null";
    case LocatedJson::Kind::flag:
      return json.flag ? "true" : "false";
    case LocatedJson::Kind::number:
      return text_from(json.number);
    case LocatedJson::Kind::text:
      return in_quotes(json.text);
    case LocatedJson::Kind::array:
      return "a list of " + std::to_string(json.items.size());
    case LocatedJson::Kind::object:
      break;
  }
  return "an object";
}

double number_of(const LocatedJson& json, const std::string& name, double least, double most, std::string_view unit,
                 const std::string& where) {
  const std::string place = where + ":" + std::to_string(json.line);
  const std::string remedy = "give a number from " + text_from(least) + " to " + text_from(most) +
                             (unit.empty() ? "" : " " + std::string(unit));
  if (!json.is(LocatedJson::Kind::number))
    throw Error(place, name + ": " + described(json) + " is not a number", remedy);
  if (!std::isfinite(json.number) || json.number < least || json.number > most)
    throw Error(place, name + ": " + text_from(json.number) + " is out of range", remedy);
  return json.number;
}

std::vector<double> numbers_of(const LocatedJson& json, const std::string& name, std::size_t count, double least,
                               double most, std::string_view unit, const std::string& where) {
  if (!json.is(LocatedJson::Kind::array) || json.items.size() != count)
    throw Error(where + ":" + std::to_string(json.line),
                name + ": " + described(json) + " is not a list of " + std::to_string(count) + " numbers",
                "write [" + std::string(count == 3 ? "x, y, z" : "x, y, z, w") + "]");
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(number_of(json.items[i], name + "[" + std::to_string(i) + "]", least, most, unit, where));
  return numbers;
}

glm::dvec3 position_of(const LocatedJson& json, const std::string& name, const std::string& where) {
  const std::vector<double> xyz = numbers_of(json, name, 3, -1e7, 1e7, "m", where);
  number_of(json.items[1], name + "[1]", -1e4, 1e5, "m", where);
  return {xyz[0], xyz[1], xyz[2]};
}

ObjectReader::ObjectReader(const LocatedJson& json, std::string name, const std::string& where, Faults& faults)
    : json_(json), name_(std::move(name)), where_(where), faults_(faults) {
  faults_.attempt([&] {
    if (!json.is(LocatedJson::Kind::object))
      throw Error(place(json),
                  (name_.empty() ? "the file holds " : name_ + ": ") + described(json) +
                      (name_.empty() ? "" : " is not an object"),
                  "write {\"key\": value, ...}");
  });
}

const LocatedJson* ObjectReader::optional(std::string_view key) {
  asked_.push_back(key);
  return json_.member(key);
}

const LocatedJson* ObjectReader::required(std::string_view key, std::string_view example) {
  const LocatedJson* found = optional(key);
  faults_.attempt([&] {
    if (found == nullptr && json_.is(LocatedJson::Kind::object))
      throw Error(place(json_), "the key " + in_quotes(key_name(key)) + " is missing", "add " + std::string(example));
  });
  return found;
}

double ObjectReader::number(std::string_view key, double least, double most, double fallback, std::string_view unit) {
  double value = fallback;
  if (const LocatedJson* found = optional(key))
    faults_.attempt([&] { value = number_of(*found, key_name(key), least, most, unit, where_); });
  return value;
}

double ObjectReader::required_number(std::string_view key, double least, double most, std::string_view unit) {
  double value = least;
  if (const LocatedJson* found =
          required(key, "\"" + std::string(key) + "\": a number from " + text_from(least) + " to " + text_from(most) +
                            (unit.empty() ? "" : " " + std::string(unit))))
    faults_.attempt([&] { value = number_of(*found, key_name(key), least, most, unit, where_); });
  return value;
}

std::string ObjectReader::text(std::string_view key, std::string fallback) {
  const LocatedJson* found = optional(key);
  if (found == nullptr) return fallback;
  faults_.attempt([&] {
    if (!found->is(LocatedJson::Kind::text))
      throw Error(place(*found), key_name(key) + ": " + described(*found) + " is not text", "write \"text\"");
    fallback = found->text;
  });
  return fallback;
}

bool ObjectReader::flag(std::string_view key, bool fallback) {
  const LocatedJson* found = optional(key);
  if (found == nullptr) return fallback;
  faults_.attempt([&] {
    if (!found->is(LocatedJson::Kind::flag))
      throw Error(place(*found), key_name(key) + ": " + described(*found) + " is neither true nor false", "write true");
    fallback = found->flag;
  });
  return fallback;
}

void ObjectReader::version() {
  const LocatedJson* version = required("version", "\"version\": 1");
  faults_.attempt([&] {
    if (version != nullptr && (!version->is(LocatedJson::Kind::number) || version->number != 1.0))
      throw Error(place(*version), key_name("version") + ": " + described(*version) + " is not known",
                  "give version 1, the one this program reads");
  });
}

void ObjectReader::finish() {
  if (!json_.is(LocatedJson::Kind::object)) return;
  for (const LocatedJson& item : json_.items) {
    if (std::find(asked_.begin(), asked_.end(), item.key) != asked_.end()) continue;
    faults_.attempt([&] {
      throw Error(place(item), "unknown key " + in_quotes(key_name(item.key)) + did_you_mean(item.key, asked_),
                  "remove it, or take one of: " + listed(asked_, "and"));
    });
  }
}

}  // namespace seascape
