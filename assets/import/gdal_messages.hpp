/// What GDAL has to say, as text instead of prints.
#pragma once

#include <cpl_error.h>

#include <string>

namespace vicus::assets {

/// While it lives, GDAL prints nothing in this thread; failures collect in `text`. Also registers GDAL's drivers.
class GdalMessages {
 public:
  GdalMessages();
  ~GdalMessages();
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;

  /// The failures since the last call, joined by "; "; then forgets them.
  std::string take();

 private:
  static void CPL_STDCALL handle(CPLErr severity, CPLErrorNum number, const char* message);
  std::string text_;
  unsigned count_ = 0;
};

}  // namespace vicus::assets
