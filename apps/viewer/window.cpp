#include "apps/viewer/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "penumbra/mesh/error.h"

namespace penumbra::viewer {
namespace {

std::string glfw_reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

void* load(const char* name) {
  return reinterpret_cast<void*>(glfwGetProcAddress(name));
}

void set_style() {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0.0f;
  style.FrameRounding = 3.0f;
  style.WindowBorderSize = 0.0f;
}

// After the backend has read the real mouse.
void apply(const Window::Hand& hand) {
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {hand.x, hand.y};
  std::copy(std::begin(hand.down), std::end(hand.down), std::begin(io.MouseDown));
  io.MouseWheel = hand.wheel;
  io.KeyShift = hand.shift;
  io.KeysDown[GLFW_KEY_ENTER] = hand.enter;
  if (hand.character) io.AddInputCharacter(hand.character);
}

}  // namespace

Window::Window(int width, int height, const std::string& title) {
  glfwSetErrorCallback(nullptr);
  if (!glfwInit())
    throw SystemError("no window: " + glfw_reason() +
                      "; the viewer needs a display (DISPLAY, or xvfb-run), penumbra render does not");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SAMPLES, 0);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!window_) {
    const std::string reason = glfw_reason();
    glfwTerminate();
    throw SystemError("no window: " + reason + "; the viewer needs OpenGL 4.5");
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  try {
    gl_ = gl::load_functions(load);
  } catch (...) {
    glfwTerminate();
    throw;
  }
  glfwSetWindowUserPointer(window_, this);
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    static_cast<Window*>(glfwGetWindowUserPointer(window))->drop({paths, paths + count});
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int mods) {
    if (action == GLFW_PRESS)
      static_cast<Window*>(glfwGetWindowUserPointer(window))
          ->keys_.push_back({key, (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0});
  });
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  set_style();
  ImGui_ImplGlfw_InitForOpenGL(window_, true);  // calls the callbacks above, too
  ImGui_ImplOpenGL3_Init("#version 450 core");
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool Window::closing() const {
  return glfwWindowShouldClose(window_) != 0;
}
void Window::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}
bool Window::minimised() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return width == 0 || height == 0 || glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0;
}
void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}
void Window::set_size(int width, int height) {
  glfwSetWindowSize(window_, width, height);
}

void Window::drop(const std::vector<std::string>& paths) {
  dropped_.insert(dropped_.end(), paths.begin(), paths.end());
}

std::pair<int, int> Window::size() const {
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return {width, height};
}

std::vector<std::string> Window::take_dropped() {
  return std::exchange(dropped_, {});
}

std::vector<Window::Key> Window::take_keys() {
  return std::exchange(keys_, {});
}

void Window::wait(double seconds) {
  if (seconds < 0.0)
    glfwWaitEvents();
  else
    glfwWaitEventsTimeout(std::max(seconds, 1e-3));
}

void Window::wake() {
  glfwPostEmptyEvent();
}

void Window::begin_frame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  if (hand_) apply(*hand_);
  ImGui::NewFrame();
}

void Window::draw_frame() {
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl_.Viewport(0, 0, width, height);
  const float background[4] = {0.12f, 0.12f, 0.13f, 1.0f};
  gl_.ClearBufferfv(GL_COLOR, 0, background);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::show_frame() {
  glfwSwapBuffers(window_);
}

std::vector<unsigned char> Window::read_pixels(int& width, int& height) const {
  glfwGetFramebufferSize(window_, &width, &height);
  const std::size_t row = static_cast<std::size_t>(width) * 3;
  std::vector<unsigned char> pixels(row * static_cast<std::size_t>(height));
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadBuffer(GL_BACK);
  gl_.ReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  for (int y = 0; y < height / 2; ++y)
    std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(row) * y,
                     pixels.begin() + static_cast<std::ptrdiff_t>(row) * (y + 1),
                     pixels.begin() + static_cast<std::ptrdiff_t>(row) * (height - 1 - y));
  return pixels;
}

}  // namespace penumbra::viewer
