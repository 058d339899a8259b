// The exceptions of the library. Each message says what happened, where (file, line or field) and what to do
// about it. Geometric findings (boundary edges, self-intersections) are no errors: they are returned as data.
#pragma once

#include <stdexcept>
#include <string>

namespace penumbra {

/// Base of every exception thrown on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A mesh that cannot be used: unreadable, truncated, empty, coordinates that are NaN or infinite, indices
/// out of range.
class MeshError : public Error {
 public:
  using Error::Error;
};

/// A scene that cannot be used: malformed JSON, missing or wrong keys, negative radius, zero normal, singular
/// matrix.
class SceneError : public Error {
 public:
  using Error::Error;
};

/// An option outside its domain: unknown method, image of size 0x0, no samples.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// Something outside failed: a file cannot be written, no OpenGL context starts.
class SystemError : public Error {
 public:
  using Error::Error;
};

/// Thrown by long calls when their progress callback asked to stop.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

}  // namespace penumbra
