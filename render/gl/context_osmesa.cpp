// OSMesa: Mesa's off-screen software renderer. libOSMesa is opened at run time with RTLD_LOCAL, so that its
// copy of the GL entry points never meets another's.
#include <GL/glcorearb.h>
#include <dlfcn.h>

#include <array>
#include <cerrno>
#include <new>
#include <vector>

#include "penumbra/mesh/error.h"
#include "render/gl/context_backends.h"
#include "render/support/library_memory.h"

namespace penumbra::gl {
namespace {

// From OSMesa's documented interface; its header would pull in <GL/gl.h>.
constexpr int kFormat = 0x22, kDepthBits = 0x30, kStencilBits = 0x31, kProfile = 0x33, kCoreProfile = 0x34,
              kMajorVersion = 0x36, kMinorVersion = 0x37, kRgba = 0x1908;
using OsMesaContext = struct osmesa_context*;

struct Library {
  void* handle = nullptr;
  OsMesaContext (*create)(const int*, OsMesaContext) = nullptr;
  void (*destroy)(OsMesaContext) = nullptr;
  unsigned char (*make_current)(OsMesaContext, void*, GLenum, GLsizei, GLsizei) = nullptr;
  void* (*proc_address)(const char*) = nullptr;
};

template <class Function>
void load(void* handle, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(handle, name));
  if (!function)
    throw SystemError(std::string("libOSMesa lacks ") + name + ": install the Debian package libosmesa6");
}

/// Opened once and never closed: unloading Mesa while its threads wind down is not safe.
const Library& library() {
  static const Library opened = [] {
    Library lib;
    for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"})
      if ((lib.handle = dlopen(name, RTLD_NOW | RTLD_LOCAL))) break;
    if (!lib.handle) detail::require_memory_for_library(dlerror());
    if (!lib.handle)
      throw SystemError(
          "cannot open libOSMesa.so.8: install the Debian package libosmesa6, or use option backend egl");
    load(lib.handle, "OSMesaCreateContextAttribs", lib.create);
    load(lib.handle, "OSMesaDestroyContext", lib.destroy);
    load(lib.handle, "OSMesaMakeCurrent", lib.make_current);
    load(lib.handle, "OSMesaGetProcAddress", lib.proc_address);
    return lib;
  }();
  return opened;
}

class OsMesa final : public Context {
 public:
  OsMesa() {
    const std::array<int, 13> wanted{kFormat,  kRgba,        kDepthBits,    24, kStencilBits,  8,
                                     kProfile, kCoreProfile, kMajorVersion, 4,  kMinorVersion, 5,
                                     0};
    errno = 0;
    context_ = library().create(wanted.data(), nullptr);
    if (!context_ && errno == ENOMEM) throw std::bad_alloc();
    if (!context_)
      throw SystemError(
          "OSMesa gives no OpenGL 4.5 core context: install Mesa 22 or newer, or use option backend egl");
    make_current();
    functions_ = load_functions(library().proc_address);
    renderer_ = renderer_string(functions_);
  }
  ~OsMesa() override { library().destroy(context_); }
  void make_current() override {
    if (!library().make_current(context_, pixels_.data(), GL_UNSIGNED_BYTE, 1, 1))
      throw SystemError("OSMesa cannot make its context current");
  }
  const Functions& functions() const override { return functions_; }
  std::string renderer() const override { return renderer_; }

 private:
  OsMesaContext context_ = nullptr;
  std::array<unsigned char, 4> pixels_{};  // everything is drawn into framebuffer objects
  Functions functions_;
  std::string renderer_;
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context() {
  return std::make_unique<OsMesa>();
}

}  // namespace penumbra::gl
