#ifdef ITEM_ID
flat in uint item;
layout(location = 0) out uint shownItem;

void main() {
  shownItem = item;
}
#else
#include "lighting.glsl"
in vec3 scale;
in vec3 add;
layout(location = 0) out vec4 shown;

void main() {
  shown = vec4(displayed(scale + add), 1.0);
}
#endif
