#include "apps/viewer/window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "apps/viewer/window/font.h"
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

float display_scale() {
  float x = 1.0f, y = 1.0f;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorContentScale(monitor, &x, &y);
  return std::clamp(x, 1.0f, 4.0f);
}

// Letters by what is on the key: Ctrl+Z is where the keyboard has its Z.
int key_by_letter(int key, int scancode) {
  const char* name = glfwGetKeyName(key, scancode);
  const bool letter = name && name[0] >= 'a' && name[0] <= 'z' && name[1] == '\0';
  return letter ? GLFW_KEY_A + (name[0] - 'a') : key;
}

void set_style(float font) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.ScaleAllSizes(font / 15.0f);
  style.ItemSpacing.y = style.FramePadding.y = 0.2f * font;
  style.WindowRounding = 0.0f;
  style.FrameRounding = style.GrabRounding = style.PopupRounding = 3.0f;
  style.WindowBorderSize = 0.0f;
  style.PopupBorderSize = 1.0f;
  style.Colors[ImGuiCol_SliderGrab] = {0.24f, 0.52f, 0.88f, 0.55f};  // what is written is seen through it
  style.Colors[ImGuiCol_WindowBg] = {0.11f, 0.115f, 0.13f, 1.0f};
  style.Colors[ImGuiCol_PopupBg] = {0.15f, 0.155f, 0.175f, 1.0f};
  style.Colors[ImGuiCol_MenuBarBg] = {0.15f, 0.155f, 0.175f, 1.0f};
  style.Colors[ImGuiCol_TitleBgActive] = {0.2f, 0.27f, 0.38f, 1.0f};
  style.Colors[ImGuiCol_ModalWindowDimBg] = {0.0f, 0.0f, 0.0f, 0.45f};
}

void load_font(float pixels) {
  static constexpr ImWchar kRanges[] = {0x0020, 0x024F, 0x0370, 0x03FF, 0x0400, 0x04FF,
                                        0x2010, 0x2027, 0x2190, 0x2193, 0x2212, 0x2212,
                                        0x2248, 0x2248, 0x2264, 0x2265, 0};
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  const std::span<const unsigned char> file = font_file();
  ImGui::GetIO().Fonts->AddFontFromMemoryTTF(const_cast<unsigned char*>(file.data()),  // only read
                                             static_cast<int>(file.size()), pixels, &config, kRanges);
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

Window::Window(const WindowOptions& options) {
  glfwSetErrorCallback(nullptr);
  if (!glfwInit())
    throw SystemError("no window: " + glfw_reason() +
                      "; the viewer needs a display (DISPLAY, or xvfb-run), penumbra render does not");
  look_.font = options.font > 0.0 ? static_cast<float>(options.font) : 15.0f * display_scale();
  make_context(options);
  set_callbacks();
  start_imgui();
}

void Window::make_context(const WindowOptions& options) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SAMPLES, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 8);
  window_ = glfwCreateWindow(options.width + (options.plain ? 0 : look_.panel_width()),
                             options.height + (options.plain ? 0 : look_.status_height()), "Penumbra",
                             nullptr, nullptr);
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
}

void Window::set_callbacks() {
  glfwSetWindowUserPointer(window_, this);
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    static_cast<Window*>(glfwGetWindowUserPointer(window))->drop({paths, paths + count});
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int mods) {
    if (action == GLFW_PRESS)
      static_cast<Window*>(glfwGetWindowUserPointer(window))
          ->keys_.push_back(
              {key_by_letter(key, scancode), (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0});
  });
}

void Window::start_imgui() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  set_style(look_.font);
  load_font(look_.font);
  load_font(2.0f * look_.font);
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
void Window::stay_open() {
  glfwSetWindowShouldClose(window_, GLFW_FALSE);
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

bool Window::wait(double seconds) {
  if (seconds < 0.0) {
    glfwWaitEvents();
    return true;
  }
  const double end = glfwGetTime() + std::max(seconds, 1e-3);
  glfwWaitEventsTimeout(std::max(seconds, 1e-3));
  return glfwGetTime() < end;
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
