#include "terrain/triangle_distance.hpp"

namespace vicus::terrain {

Batch::Lanes distancesSquared(const Batch& t) {
  Batch::Lanes result;
  for (size_t l = 0; l < Batch::kLanes; ++l) {
    const float ax = t.a[0][l], ay = t.a[1][l], az = t.a[2][l];
    const float bx = t.b[0][l], by = t.b[1][l], bz = t.b[2][l];
    const float px = t.apex[0][l], py = t.apex[1][l], pz = t.apex[2][l];
    const float abx = bx - ax, aby = by - ay, abz = bz - az;
    const float bpx = px - bx, bpy = py - by, bpz = pz - bz;
    const float pax = ax - px, pay = ay - py, paz = az - pz;
    const float aa = ax * ax + ay * ay + az * az, bb = bx * bx + by * by + bz * bz, pp = px * px + py * py + pz * pz;
    const float ab = abx * abx + aby * aby + abz * abz, bp = bpx * bpx + bpy * bpy + bpz * bpz,
                pa = pax * pax + pay * pay + paz * paz;
    // The nearest points of the three edges; an edge without length is its end.
    const float toAb = -(ax * abx + ay * aby + az * abz), toBp = -(bx * bpx + by * bpy + bz * bpz),
                toPa = -(px * pax + py * pay + pz * paz);
    const float alongAb = toAb > 0 ? (toAb < ab ? toAb : ab) : 0, alongBp = toBp > 0 ? (toBp < bp ? toBp : bp) : 0,
                alongPa = toPa > 0 ? (toPa < pa ? toPa : pa) : 0;
    const float tiny = 1e-30F;
    const float tAb = alongAb / (ab + tiny), tBp = alongBp / (bp + tiny), tPa = alongPa / (pa + tiny);
    const float dAb = aa + tAb * (tAb * ab - 2 * toAb), dBp = bb + tBp * (tBp * bp - 2 * toBp),
                dPa = pp + tPa * (tPa * pa - 2 * toPa);
    float d = dAb < dBp ? dAb : dBp;
    d = d < dPa ? d : dPa;
    // The plane, where the eye is over the triangle's inside.
    const float nx = aby * bpz - abz * bpy, ny = abz * bpx - abx * bpz, nz = abx * bpy - aby * bpx;
    const float nn = nx * nx + ny * ny + nz * nz, na = nx * ax + ny * ay + nz * az;
    const float sideAb = nx * (ay * bz - az * by) + ny * (az * bx - ax * bz) + nz * (ax * by - ay * bx);
    const float sideBp = nx * (by * pz - bz * py) + ny * (bz * px - bx * pz) + nz * (bx * py - by * px);
    const float sidePa = nx * (py * az - pz * ay) + ny * (pz * ax - px * az) + nz * (px * ay - py * ax);
    float inside = sideAb < sideBp ? sideAb : sideBp;
    inside = inside < sidePa ? inside : sidePa;
    const float plane = na * na / (nn + tiny);
    d = inside > 0 ? plane : d;
    result[l] = d > 0 ? d : 0;
  }
  return result;
}

}  // namespace vicus::terrain
