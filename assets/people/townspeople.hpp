/// People made by code: bodies, garments, hats and baskets by parameters, and their motions.
#pragma once

#include <string_view>
#include <vector>

#include "city/avatars.hpp"

namespace vicus::assets::people {

/// Dresses that can be asked for.
enum class Period : uint8_t { Medieval, Modern };

/// Characters of a period, men and women and a child, each with several dresses; the same each time.
std::vector<city::Character> makeTownspeople(Period period);

/// The skeleton that all of them share but for their size: 1.70 m tall, arms hanging.
const city::Skeleton& townSkeleton();

/// Motions made by code for that skeleton. Walking feet stand still on the ground while they bear.
city::Clip makeClip(city::Role role);

/// Name of a role's clip: "walk", "idle", "talk", "carry".
std::string_view nameOf(city::Role role);

}  // namespace vicus::assets::people
