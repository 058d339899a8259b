// A window with an OpenGL context and Dear ImGui in it; alive as long as this object.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/viewer/window/look.h"
#include "render/gl/functions.h"

struct GLFWwindow;

namespace penumbra::viewer {

struct WindowOptions {
  int width = 960, height = 680;  ///< of the picture
  bool plain = false;             ///< the picture is all there is
  double font = 0.0;              ///< pixels; 0: 15, times the display's scale
};

class Window {
 public:
  /// Throws SystemError where there is no display or no OpenGL 4.5.
  explicit Window(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  const gl::Functions& functions() const { return gl_; }
  bool closing() const;
  /// As if it had not been told to close.
  void stay_open();
  bool minimised() const;
  void set_title(const std::string& title);
  void set_size(int width, int height);
  const Look& look() const { return look_; }
  /// ImGui's number of the large font.
  static constexpr int kTitleFont = 1;
  /// As if these files were dropped on the window.
  void drop(const std::vector<std::string>& paths);
  /// Of all of it, pixels.
  std::pair<int, int> size() const;
  /// Files dropped since the last call.
  std::vector<std::string> take_dropped();

  /// Keys pressed since the last call, however short: ImGui only knows which are down when a frame begins.
  struct Key {
    int key;  ///< GLFW's number; of letters that of the letter on the key, whatever the keyboard's layout
    bool shift, control;
  };
  std::vector<Key> take_keys();

  /// Waits for an event at most so long; a negative time has no end. `wake` ends it from any thread. False:
  /// none came in time.
  bool wait(double seconds);
  static void wake();

  /// A hand in place of the mouse, from the next frame on.
  struct Hand {
    float x = 0.0f, y = 0.0f, wheel = 0.0f;
    bool down[3] = {};  ///< left, right, middle
    bool shift = false, enter = false;
    unsigned character = 0;  ///< typed; 0: none
  };
  void use_hand(const Hand& hand) { hand_ = hand; }

  void begin_frame();  ///< polls nothing; clears and starts ImGui's frame
  void draw_frame();   ///< everything that ImGui was told, into the back buffer
  void show_frame();   ///< swaps
  /// The back buffer as 8-bit RGB, row 0 at the top. Between draw_frame and show_frame.
  std::vector<unsigned char> read_pixels(int& width, int& height) const;

 private:
  void make_context(const WindowOptions& options);
  void set_callbacks();
  void start_imgui();

  GLFWwindow* window_ = nullptr;
  Look look_;
  gl::Functions gl_;
  std::vector<std::string> dropped_;
  std::vector<Key> keys_;
  std::optional<Hand> hand_;
};

}  // namespace penumbra::viewer
