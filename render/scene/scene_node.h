// One value of a scene file together with where it stands, so that every complaint names its key.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

/// What reading a scene leaves behind besides the scene.
struct SceneNotes {
  std::string name;     ///< the file, for messages
  bool strict = false;  ///< unknown keys are errors
  std::vector<std::string> warnings;

  void warn(const std::string& message) { warnings.push_back(name + ": " + message); }
};

/// Refers to `value` and `notes`, which must outlive it. Every getter throws SceneError for another type than
/// asked for, number() and what is made of it also for values that are not finite or beyond kMostNumber.
class SceneNode {
 public:
  SceneNode(const nlohmann::json& value, nlohmann::json::json_pointer path, SceneNotes& notes)
      : value_(value), path_(std::move(path)), notes_(notes) {}

  SceneNode required(const std::string& key) const;
  std::optional<SceneNode> find(const std::string& key) const;
  std::vector<SceneNode> elements() const;

  double number() const;
  std::vector<double> numbers(std::size_t count) const;
  Vec3 vec3() const;
  Vec3 number_or_vec3() const;  ///< one number stands for three equal ones
  std::string text() const;
  bool boolean() const;
  bool is_array() const { return value_.is_array(); }

  /// Requires an object; warns about keys that are neither listed nor begin with `x-` (SceneError when
  /// strict).
  void allow_only(std::initializer_list<std::string_view> keys) const;
  void warn(const std::string& message) const { notes_.warn(where() + ": " + message); }
  [[noreturn]] void fail(const std::string& message) const;
  /// The message behind the file's name and where().
  std::string located(const std::string& message) const;
  /// A JSON pointer such as /objects/1/scale.
  std::string where() const;

 private:
  const nlohmann::json& value_;
  nlohmann::json::json_pointer path_;
  SceneNotes& notes_;
};

/// A number as a person would write it, for messages.
std::string to_text(double value);

}  // namespace penumbra::detail
