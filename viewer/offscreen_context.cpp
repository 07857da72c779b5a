#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstring>
#include <vector>

#include "scenegraph/gl.hpp"
#include "viewer/renderer.hpp"

namespace vicus::viewer {
namespace {

template <typename Function>
Function eglFunction(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

/// Displays that need no window system, the likeliest first: Mesa's surfaceless platform, then each EGL device.
std::vector<EGLDisplay> displaysWithoutWindows() {
  std::vector<EGLDisplay> displays;
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto has = [&](const char* name) { return extensions && std::strstr(extensions, name); };
  const auto getDisplay = eglFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  const auto queryDevices = eglFunction<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  if (getDisplay && has("EGL_MESA_platform_surfaceless"))
    displays.push_back(getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  if (getDisplay && queryDevices && has("EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    queryDevices(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (EGLint i = 0; i < count; ++i)
      displays.push_back(getDisplay(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<size_t>(i)], nullptr));
  }
  displays.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
  return displays;
}

/// Invariant: `display` is initialised and `context` belongs to it until the end.
class OffscreenContext : public GlContext {
 public:
  OffscreenContext(EGLDisplay display, EGLSurface surface, EGLContext context)
      : display_(display), surface_(surface), context_(context) {}
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;
  ~OffscreenContext() override {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
    eglDestroyContext(display_, context_);
  }

  void makeCurrent() override { eglMakeCurrent(display_, surface_, surface_, context_); }
  void swap() override {}
  std::string rendererName() const override {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return name ? name : "";
  }

 private:
  EGLDisplay display_;
  EGLSurface surface_;
  EGLContext context_;
};

/// A context on one display, or null with the step that failed.
std::unique_ptr<GlContext> contextOn(EGLDisplay display, std::string& error) {
  EGLint major = 0, minor = 0;
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) {
    error = "EGL display cannot be initialised";
    return nullptr;
  }
  if (!eglBindAPI(EGL_OPENGL_API)) {
    error = "EGL has no desktop OpenGL";
    return nullptr;
  }
  const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_RED_SIZE, 8,
                           EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (!eglChooseConfig(display, wanted, &config, 1, &configs) || configs < 1) {
    error = "EGL display has no configuration for pixel buffers";
    return nullptr;
  }
  for (const EGLint version : {5, 4, 3}) {
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 version,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                                 EGL_NONE};
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) continue;
    // We draw into framebuffers of our own; a surface of one pixel serves drivers that cannot do without.
    const EGLint onePixel[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    const EGLSurface surface = eglCreatePbufferSurface(display, config, onePixel);
    if (eglMakeCurrent(display, surface, surface, context))
      return std::make_unique<OffscreenContext>(display, surface, context);
    if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
    eglDestroyContext(display, context);
  }
  error = "EGL gives no OpenGL 4.3 compatibility context";
  return nullptr;
}

}  // namespace

std::unique_ptr<GlContext> makeOffscreenContext(std::string& error) {
  error = "no EGL display";
  for (const EGLDisplay display : displaysWithoutWindows())
    if (auto context = contextOn(display, error)) {
      error.clear();
      return context;
    }
  return nullptr;
}

}  // namespace vicus::viewer
