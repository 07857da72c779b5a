/// A whole city as bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "city/city.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets {

struct CachedCity {
  city::City city;
  city::Diagnostics diagnostics;  ///< what was said when it was read from its files
};

/// Every field, bit for bit; in the machine's own byte order, so only for this machine's cache.
std::string encodeCity(const CachedCity& city);
/// The inverse. Nothing where the bytes are not those of a whole city; never reads beyond them.
std::optional<CachedCity> decodeCity(std::string_view bytes);

}  // namespace vicus::assets
