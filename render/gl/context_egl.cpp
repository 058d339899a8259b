// EGL without any surface (Mesa's surfaceless platform). libEGL is opened at run time.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include "penumbra/mesh/error.h"
#include "render/gl/context_backends.h"
#include "render/support/library_memory.h"

namespace penumbra::gl {
namespace {

struct Library {
  void* handle = nullptr;
  decltype(&eglGetProcAddress) proc_address = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglBindAPI) bind_api = nullptr;
  decltype(&eglChooseConfig) choose_config = nullptr;
  decltype(&eglCreateContext) create_context = nullptr;
  decltype(&eglDestroyContext) destroy_context = nullptr;
  decltype(&eglMakeCurrent) make_current = nullptr;
};

template <class Function>
void load(void* handle, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(handle, name));
  if (!function)
    throw SystemError(std::string("libEGL lacks ") + name + ": install the Debian package libegl1");
}

const Library& library() {
  static const Library opened = [] {
    Library lib;
    lib.handle = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!lib.handle) detail::require_memory_for_library(dlerror());
    if (!lib.handle)
      throw SystemError(
          "cannot open libEGL.so.1: install the Debian packages libegl1 and libegl-mesa0, or use option "
          "backend "
          "osmesa");
    load(lib.handle, "eglGetProcAddress", lib.proc_address);
    load(lib.handle, "eglInitialize", lib.initialize);
    load(lib.handle, "eglBindAPI", lib.bind_api);
    load(lib.handle, "eglChooseConfig", lib.choose_config);
    load(lib.handle, "eglCreateContext", lib.create_context);
    load(lib.handle, "eglDestroyContext", lib.destroy_context);
    load(lib.handle, "eglMakeCurrent", lib.make_current);
    return lib;
  }();
  return opened;
}

[[noreturn]] void fail(const char* what) {
  throw SystemError(
      std::string("EGL surfaceless: ") + what +
      ": install the Debian packages libegl-mesa0 and libgl1-mesa-dri, or use option backend osmesa");
}

class Egl final : public Context {
 public:
  Egl() {
    const auto get_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(library().proc_address("eglGetPlatformDisplayEXT"));
    if (!get_display) fail("no platform displays");
    display_ = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || !library().initialize(display_, nullptr, nullptr)) fail("no display");
    if (!library().bind_api(EGL_OPENGL_API)) fail("no OpenGL");
    const EGLint config_wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                    EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (!library().choose_config(display_, config_wanted, &config, 1, &found) || found < 1)
      fail("no configuration");
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                             4,
                             EGL_CONTEXT_MINOR_VERSION,
                             5,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                             EGL_NONE};
    context_ = library().create_context(display_, config, EGL_NO_CONTEXT, wanted);
    if (context_ == EGL_NO_CONTEXT) fail("no OpenGL 4.5 core context");
    make_current();
    functions_ = load_functions(
        [](const char* name) { return reinterpret_cast<void*>(library().proc_address(name)); });
    renderer_ = renderer_string(functions_);
  }
  ~Egl() override {
    library().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    library().destroy_context(display_, context_);
  }
  void make_current() override {
    if (!library().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      fail("cannot make the context current");
  }
  const Functions& functions() const override { return functions_; }
  std::string renderer() const override { return renderer_; }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  Functions functions_;
  std::string renderer_;
};

}  // namespace

std::unique_ptr<Context> make_egl_context() {
  return std::make_unique<Egl>();
}

}  // namespace penumbra::gl
