#include "assets/import/gdal_messages.hpp"

#include <gdal.h>

#include <utility>

namespace vicus::assets {

GdalMessages::GdalMessages() {
  GDALAllRegister();
  CPLPushErrorHandlerEx(&GdalMessages::handle, this);
}

GdalMessages::~GdalMessages() {
  CPLPopErrorHandler();
  CPLErrorReset();
}

std::string GdalMessages::take() {
  count_ = 0;
  return std::exchange(text_, {});
}

void CPL_STDCALL GdalMessages::handle(CPLErr severity, CPLErrorNum, const char* message) {
  auto* self = static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
  constexpr unsigned kKept = 4;  // a broken file can fail at every block
  if (severity < CE_Failure || !self || ++self->count_ > kKept) return;
  if (!self->text_.empty()) self->text_ += "; ";
  self->text_ += message;
}

}  // namespace vicus::assets
