/// Which state of the code made an entry of the cache.
#pragma once

namespace vicus::assets {

/// A hash of the sources that decide what becomes of a file, made when they are compiled: an entry made by other code
/// is rebuilt.
extern const char* const kBuilderVersion;

}  // namespace vicus::assets
