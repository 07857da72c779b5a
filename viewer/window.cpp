#include "viewer/window.hpp"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "viewer/gamepad.hpp"

namespace vicus::viewer {
namespace {

/// What GLFW says of its last failure.
std::string glfwReason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

/// The newest compatibility context that there is; null where none is new enough.
GLFWwindow* createWindow(const Window::Options& options) {
  constexpr int kOldest = 3, kNewest = 5;  // of GL 4.x: shader storage buffers and indirect draws came with 4.3
  for (int minor = kNewest; minor >= kOldest; --minor) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_COMPAT_PROFILE);
    // Scenes are drawn into our own framebuffers; the window's only shows them.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    if (GLFWwindow* made = glfwCreateWindow(std::max(options.size.x, 1), std::max(options.size.y, 1),
                                            options.title.c_str(), nullptr, nullptr))
      return made;
  }
  return nullptr;
}

}  // namespace

struct Window::Impl {
  GLFWwindow* window = nullptr;
  bool touch = false;
  int monitor = 0;
  glm::dvec2 lastMouse{0};
  bool mouseKnown = false;  ///< false: the next position is the first, and no movement
  bool mouseFree = false;
  glm::dvec2 wheel{0};                        ///< since the last poll: right and up positive
  std::array<bool, GLFW_KEY_LAST + 1> was{};  ///< keys that were down at the last poll
  Gamepad pad;                                ///< at the last poll
  bool buttonWasDown = false;
  glm::dvec2 pressedAt{0};
  double dragged = 0;      ///< screen units since the button was pressed
  glm::ivec4 windowed{0};  ///< place and size before full screen

  bool down(std::initializer_list<int> keys) const {
    return std::any_of(keys.begin(), keys.end(), [&](int key) { return glfwGetKey(window, key) == GLFW_PRESS; });
  }
  /// True once for each press.
  bool pressed(int key) {
    const bool isDown = down({key});
    return isDown && !std::exchange(was[static_cast<size_t>(key)], isDown);
  }
  void forgetReleased() {
    for (size_t key = GLFW_KEY_SPACE; key < was.size(); ++key)
      if (was[key] && !down({static_cast<int>(key)})) was[key] = false;
  }
  void setCursor() {
    glfwSetInputMode(window, GLFW_CURSOR, mouseFree || touch ? GLFW_CURSOR_NORMAL : GLFW_CURSOR_DISABLED);
    mouseKnown = false;
  }
  void readPad(Input& input) {
    GLFWgamepadstate state;
    for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id) {
      if (!glfwJoystickIsGamepad(id) || !glfwGetGamepadState(id, &state)) continue;
      Gamepad now;
      std::copy(std::begin(state.axes), std::end(state.axes), now.axes.begin());
      std::copy(std::begin(state.buttons), std::end(state.buttons), now.buttons.begin());
      addGamepad(now, pad, input);
      pad = now;
      return;
    }
  }
  /// The pointer where it is free: where it is, and whether the button was pressed and let go on the spot.
  void readPointer(Input& input, glm::dvec2 mouse) {
    constexpr double kTapPixels = 8;
    const bool isDown = input.leftButton;
    if (isDown && !buttonWasDown) pressedAt = mouse, dragged = 0;
    if (isDown) dragged = std::max(dragged, glm::distance(mouse, pressedAt));
    const bool free = mouseFree || touch;
    input.tap = free && !isDown && buttonWasDown && dragged < kTapPixels;
    buttonWasDown = isDown;
    // Positions come in screen coordinates, which may be larger than pixels.
    glm::ivec2 screen(1), pixels(1);
    glfwGetWindowSize(window, &screen.x, &screen.y);
    glfwGetFramebufferSize(window, &pixels.x, &pixels.y);
    input.viewport = glm::max(pixels, glm::ivec2(1));
    if (free) input.pointer = mouse * glm::dvec2(pixels) / glm::dvec2(glm::max(screen, glm::ivec2(1)));
  }
};

std::string displayProblem() {
  if (!glfwInit()) return "no display: use --headless (" + glfwReason() + ")";
  glfwTerminate();
  return {};
}

std::unique_ptr<Window> Window::open(const Options& options, std::string& error) {
  error = displayProblem();
  if (!error.empty() || !glfwInit()) return nullptr;
  auto impl = std::make_unique<Impl>();
  impl->window = createWindow(options);
  if (!impl->window) {
    error =
        "no window with OpenGL 4.3 or later (compatibility profile): " + glfwReason() + "; --headless may still work";
    glfwTerminate();
    return nullptr;
  }
  std::unique_ptr<Window> window(new Window(std::move(impl)));
  window->makeCurrent();
  glfwSwapInterval(options.vsync ? 1 : 0);
  window->impl_->touch = options.touch, window->impl_->monitor = options.monitor;
  window->impl_->setCursor();
  glfwSetWindowUserPointer(window->impl_->window, window->impl_.get());
  glfwSetScrollCallback(window->impl_->window, [](GLFWwindow* w, double right, double up) {
    static_cast<Impl*>(glfwGetWindowUserPointer(w))->wheel += glm::dvec2(right, up);
  });
  // A key or button pressed and let go between two slow frames still counts for one.
  glfwSetInputMode(window->impl_->window, GLFW_STICKY_KEYS, GLFW_TRUE);
  glfwSetInputMode(window->impl_->window, GLFW_STICKY_MOUSE_BUTTONS, GLFW_TRUE);
  return window;
}

Window::Window(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Window::~Window() {
  glfwDestroyWindow(impl_->window);
  glfwTerminate();
}

void Window::makeCurrent() {
  glfwMakeContextCurrent(impl_->window);
}

void Window::swap() {
  glfwSwapBuffers(impl_->window);
}

std::string Window::rendererName() const {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name ? name : "unknown";
}

Input Window::poll() {
  glfwPollEvents();
  Impl& w = *impl_;
  Input input;
  input.forward = w.down({GLFW_KEY_W, GLFW_KEY_UP});
  input.back = w.down({GLFW_KEY_S, GLFW_KEY_DOWN});
  input.left = w.down({GLFW_KEY_A, GLFW_KEY_LEFT});
  input.right = w.down({GLFW_KEY_D, GLFW_KEY_RIGHT});
  input.up = w.down({GLFW_KEY_E, GLFW_KEY_SPACE});
  input.down = w.down({GLFW_KEY_Q});
  input.fast = w.down({GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT});
  input.quit = w.down({GLFW_KEY_ESCAPE}) || glfwWindowShouldClose(w.window);
  for (const auto& [key, mode] :
       {std::pair{GLFW_KEY_F, Mode::Fly}, {GLFW_KEY_O, Mode::Orbit}, {GLFW_KEY_M, Mode::Map}, {GLFW_KEY_T, Mode::Tour}})
    if (w.pressed(key)) input.mode = mode;
  for (int digit = 1; digit <= 9; ++digit)
    if (w.pressed(GLFW_KEY_0 + digit)) input.view = digit;
  input.takeBack = w.pressed(GLFW_KEY_B);
  input.toggleRecord = w.pressed(GLFW_KEY_R);
  input.help = w.pressed(GLFW_KEY_F1);
  input.toggleOverlay = w.pressed(GLFW_KEY_F2);
  input.toggleFreeze = w.pressed(GLFW_KEY_F3);
  input.togglePeople = w.pressed(GLFW_KEY_P);
  input.fullScreen = w.pressed(GLFW_KEY_F11);
  input.screenshot = w.pressed(GLFW_KEY_F12);
  w.forgetReleased();
  w.readPad(input);

  glm::dvec2 mouse;
  glfwGetCursorPos(w.window, &mouse.x, &mouse.y);
  // A window that is not looked at neither turns the head nor takes the next movement for a jump.
  const bool focused = glfwGetWindowAttrib(w.window, GLFW_FOCUSED) == GLFW_TRUE;
  if (focused && w.mouseKnown) input.mouse = mouse - w.lastMouse;
  w.lastMouse = mouse, w.mouseKnown = focused;
  input.leftButton = glfwGetMouseButton(w.window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
  input.rightButton = glfwGetMouseButton(w.window, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
  w.readPointer(input, mouse);
  input.drags = w.mouseFree || w.touch;
  const glm::dvec2 wheel = std::exchange(w.wheel, glm::dvec2(0));
  input.wheel = wheel.y;
  if (w.touch) input.push = wheel;
  return input;
}

void Window::freeMouse(bool free) {
  if (std::exchange(impl_->mouseFree, free) != free) impl_->setCursor();
}

std::string Window::toggleFullScreen() {
  Impl& w = *impl_;
  if (glfwGetWindowMonitor(w.window)) {
    glfwSetWindowMonitor(w.window, nullptr, w.windowed.x, w.windowed.y, w.windowed.z, w.windowed.w, GLFW_DONT_CARE);
    return {};
  }
  glfwGetWindowPos(w.window, &w.windowed.x, &w.windowed.y);
  glfwGetWindowSize(w.window, &w.windowed.z, &w.windowed.w);
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  if (count == 0) return "there is no monitor to fill";
  if (w.monitor > count)
    return "there is no monitor " + std::to_string(w.monitor) + "; there are " + std::to_string(count);
  GLFWmonitor* chosen = w.monitor > 0 ? monitors[w.monitor - 1] : monitors[0];
  // The one that the window's middle is on.
  const glm::ivec2 middle(w.windowed.x + w.windowed.z / 2, w.windowed.y + w.windowed.w / 2);
  for (int k = 0; k < count && w.monitor == 0; ++k) {
    glm::ivec2 at(0);
    glfwGetMonitorPos(monitors[k], &at.x, &at.y);
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[k]);
    if (mode && middle.x >= at.x && middle.y >= at.y && middle.x < at.x + mode->width && middle.y < at.y + mode->height)
      chosen = monitors[k];
  }
  const GLFWvidmode* mode = glfwGetVideoMode(chosen);
  if (!mode) return "the monitor does not tell its size";
  glfwSetWindowMonitor(w.window, chosen, 0, 0, mode->width, mode->height, mode->refreshRate);
  w.mouseKnown = false;
  return {};
}

double Window::contentScale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(impl_->window, &x, &y);
  return static_cast<double>(std::clamp(std::max(x, y), 0.5f, 8.0f));
}

glm::ivec2 Window::size() const {
  glm::ivec2 size(1);
  glfwGetFramebufferSize(impl_->window, &size.x, &size.y);
  return glm::max(size, glm::ivec2(1));
}

void Window::setTitle(const std::string& title) {
  glfwSetWindowTitle(impl_->window, title.c_str());
}

}  // namespace vicus::viewer
