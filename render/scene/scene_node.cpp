#include "render/scene/scene_node.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "penumbra/mesh/error.h"
#include "render/scene/scene_limits.h"
#include "render/support/nearest_word.h"

namespace penumbra::detail {

std::string to_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string SceneNode::where() const {
  return path_.empty() ? "top level" : path_.to_string();
}

std::string SceneNode::located(const std::string& message) const {
  return notes_.name + ": " + where() + ": " + message;
}

void SceneNode::fail(const std::string& message) const {
  throw SceneError(located(message));
}

SceneNode SceneNode::required(const std::string& key) const {
  if (auto node = find(key)) return *node;
  fail("\"" + key + "\" is missing; add it");
}

std::optional<SceneNode> SceneNode::find(const std::string& key) const {
  if (!value_.is_object()) fail(std::string("must be an object { … }, not ") + value_.type_name());
  const auto it = value_.find(key);
  if (it == value_.end()) return std::nullopt;
  return SceneNode(*it, path_ / key, notes_);
}

std::vector<SceneNode> SceneNode::elements() const {
  if (!value_.is_array()) fail(std::string("must be an array [ … ], not ") + value_.type_name());
  std::vector<SceneNode> nodes;
  for (std::size_t i = 0; i < value_.size(); ++i) nodes.emplace_back(value_[i], path_ / i, notes_);
  return nodes;
}

double SceneNode::number() const {
  if (!value_.is_number()) fail(std::string("must be a number, not ") + value_.type_name());
  const double number = value_.get<double>();
  if (!std::isfinite(number)) fail("must be a finite number");
  if (std::abs(number) > kMostNumber)
    fail("is " + to_text(number) + ", beyond " + to_text(kMostNumber) + "; use another unit of length");
  return number;
}

std::vector<double> SceneNode::numbers(std::size_t count) const {
  if (!value_.is_array() || value_.size() != count)
    fail("must be an array of " + std::to_string(count) + " numbers");
  std::vector<double> result;
  for (const SceneNode& element : elements()) result.push_back(element.number());
  return result;
}

Vec3 SceneNode::vec3() const {
  const std::vector<double> v = numbers(3);
  return {v[0], v[1], v[2]};
}

Vec3 SceneNode::number_or_vec3() const {
  if (value_.is_array()) return vec3();
  if (!value_.is_number()) fail("must be a number or an array of 3 numbers");
  return Vec3(number());
}

std::string SceneNode::text() const {
  if (!value_.is_string()) fail(std::string("must be a string, not ") + value_.type_name());
  return value_.get<std::string>();
}

bool SceneNode::boolean() const {
  if (!value_.is_boolean()) fail(std::string("must be true or false, not ") + value_.type_name());
  return value_.get<bool>();
}

void SceneNode::allow_only(std::initializer_list<std::string_view> keys) const {
  if (!value_.is_object()) fail(std::string("must be an object { … }, not ") + value_.type_name());
  std::string known;
  for (std::string_view key : keys) known += (known.empty() ? "" : ", ") + std::string(key);
  const std::vector<std::string> words(keys.begin(), keys.end());
  for (const auto& [key, ignored] : value_.items()) {
    if (key.starts_with("x-") || std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    const SceneNode child(ignored, path_ / key, notes_);
    const std::string message = "unknown key" + did_you_mean(key, words) + " (known here: " + known +
                                "; keys of your own begin with x-)";
    if (notes_.strict) child.fail(message);
    child.warn(message + ", ignored");
  }
}

}  // namespace penumbra::detail
