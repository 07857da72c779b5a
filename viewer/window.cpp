#include "viewer/window.hpp"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <iterator>
#include <utility>

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
    if (GLFWwindow* made = glfwCreateWindow(std::max(options.size.x, 1), std::max(options.size.y, 1),
                                            options.title.c_str(), nullptr, nullptr))
      return made;
  }
  return nullptr;
}

}  // namespace

struct Window::Impl {
  GLFWwindow* window = nullptr;
  glm::dvec2 lastMouse{0};
  bool mouseKnown = false;  ///< false: the next position is the first, and no movement
  bool mouseFree = false;
  double wheel = 0;  ///< since the last poll
  struct Toggle {
    int key;
    bool wasDown = false;
  };
  Toggle flight{GLFW_KEY_F}, overlay{GLFW_KEY_F2}, freeze{GLFW_KEY_F3};

  /// True once for each press.
  bool pressed(Toggle& toggle) {
    const bool isDown = down({toggle.key});
    const bool wasDown = std::exchange(toggle.wasDown, isDown);
    return isDown && !wasDown;
  }

  bool down(std::initializer_list<int> keys) const {
    return std::any_of(keys.begin(), keys.end(), [&](int key) { return glfwGetKey(window, key) == GLFW_PRESS; });
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
  glfwSetInputMode(window->impl_->window, GLFW_CURSOR, GLFW_CURSOR_DISABLED);
  glfwSetWindowUserPointer(window->impl_->window, window->impl_.get());
  glfwSetScrollCallback(window->impl_->window, [](GLFWwindow* w, double, double notches) {
    static_cast<Impl*>(glfwGetWindowUserPointer(w))->wheel += notches;
  });
  // A key pressed and let go between two slow frames still counts for one.
  glfwSetInputMode(window->impl_->window, GLFW_STICKY_KEYS, GLFW_TRUE);
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
  input.toggleFlight = w.pressed(w.flight);
  input.toggleOverlay = w.pressed(w.overlay);
  input.toggleFreeze = w.pressed(w.freeze);
  input.leftButton = glfwGetMouseButton(w.window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
  input.rightButton = glfwGetMouseButton(w.window, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
  input.wheel = std::exchange(w.wheel, 0.0);

  glm::dvec2 mouse;
  glfwGetCursorPos(w.window, &mouse.x, &mouse.y);
  // A window that is not looked at neither turns the head nor takes the next movement for a jump.
  const bool focused = glfwGetWindowAttrib(w.window, GLFW_FOCUSED) == GLFW_TRUE;
  if (focused && w.mouseKnown) input.mouse = mouse - w.lastMouse;
  w.lastMouse = mouse, w.mouseKnown = focused;
  // The pointer is told in screen coordinates, which may be larger than pixels.
  glm::ivec2 screen(1), pixels(1);
  glfwGetWindowSize(w.window, &screen.x, &screen.y);
  glfwGetFramebufferSize(w.window, &pixels.x, &pixels.y);
  if (w.mouseFree) input.pointer = mouse * glm::dvec2(pixels) / glm::dvec2(glm::max(screen, glm::ivec2(1)));
  return input;
}

void Window::freeMouse(bool free) {
  if (std::exchange(impl_->mouseFree, free) == free) return;
  glfwSetInputMode(impl_->window, GLFW_CURSOR, free ? GLFW_CURSOR_NORMAL : GLFW_CURSOR_DISABLED);
  impl_->mouseKnown = false;
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
