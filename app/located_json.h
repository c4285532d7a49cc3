// JSON in which every value knows its line, so that a fault in a scene or a path can name its place.
#pragma once
#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "app/faults.h"

namespace seascape {

struct LocatedJson {
  enum class Kind { null, flag, number, text, array, object };

  Kind kind = Kind::null;
  int line = 1;     // of a member: its key's line
  std::string key;  // of an object's member
  std::string text;
  double number = 0.0;
  bool flag = false;
  std::vector<LocatedJson> items;  // of an array, or an object's members in the file's order, keys unique

  bool is(Kind other) const { return kind == other; }
  const LocatedJson* member(std::string_view name) const;  // of an object, or nullptr
};

// Limits against hostile files.
constexpr std::size_t largest_json_bytes = 16u << 20;
constexpr std::size_t deepest_json = 64;
constexpr std::size_t most_json_values = 2'000'000;

// Throws Error("WHERE:LINE", ...) for what is not JSON, a zero byte, a key given twice, a number past double's range,
// more than 64 levels, 2 million values or 16 MiB.
LocatedJson parse_located_json(std::string_view text, const std::string& where);

// Reads members of one object and refuses whatever it was not asked for. `where` is the file; faults add the line and
// go to `faults`; where they are collected, a value with a fault reads as its fallback.
class ObjectReader {
 public:
  // `name` is what messages call the object: "camera", "keys[3]", "" for the file itself.
  ObjectReader(const LocatedJson& json, std::string name, const std::string& where, Faults& faults);

  const LocatedJson* optional(std::string_view key);
  // A fault and nullptr where the key is missing; `example` is what the remedy says to add.
  const LocatedJson* required(std::string_view key, std::string_view example);

  // A finite number in [least, most]; `fallback` where the key is absent.
  double number(std::string_view key, double least, double most, double fallback, std::string_view unit);
  double required_number(std::string_view key, double least, double most, std::string_view unit);
  std::string text(std::string_view key, std::string fallback);
  bool flag(std::string_view key, bool fallback);
  // "version": 1, at the start of every file of ours.
  void version();

  // Refuses keys that nothing above asked for; names the nearest known key.
  void finish();

  std::string key_name(std::string_view key) const {
    return name_.empty() ? std::string(key) : name_ + "." + std::string(key);
  }
  std::string place(const LocatedJson& json) const { return where_ + ":" + std::to_string(json.line); }

 private:
  const LocatedJson& json_;
  std::string name_;
  const std::string& where_;
  Faults& faults_;
  std::vector<std::string_view> asked_;
};

// A finite number in [least, most]; Error("WHERE:LINE", "NAME: 7 is out of range", "give a number from 0 to 5 m").
double number_of(const LocatedJson& json, const std::string& name, double least, double most, std::string_view unit,
                 const std::string& where);
// An array of exactly `count` such numbers.
std::vector<double> numbers_of(const LocatedJson& json, const std::string& name, std::size_t count, double least,
                               double most, std::string_view unit, const std::string& where);
// World coordinates in metres: x and z within 1e7, y from -1e4 to 1e5.
glm::dvec3 position_of(const LocatedJson& json, const std::string& name, const std::string& where);

// The value for a message: 7, 'text', true, null, a list, an object.
std::string described(const LocatedJson& json);

}  // namespace seascape
