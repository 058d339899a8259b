// An OpenGL 4.5 core context without a window. Backends are opened at run time; no GL library is linked.
#pragma once

#include <memory>
#include <string>

namespace penumbra::gl {

enum class Backend { kOsMesa, kEgl };
Backend backend_of(const std::string& name);  ///< "osmesa" or "egl"; throws UsageError
const char* name_of(Backend backend);

struct Functions;

class Context {
 public:
  virtual ~Context() = default;
  virtual void make_current() = 0;
  virtual const Functions& functions() const = 0;
  /// GL_RENDERER and GL_VERSION, for --stats: images are bit-identical where these are.
  virtual std::string renderer() const = 0;
};

/// Throws SystemError naming the Debian package to install where the backend does not start.
std::unique_ptr<Context> make_context(Backend backend);

}  // namespace penumbra::gl
