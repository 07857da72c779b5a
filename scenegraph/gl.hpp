/// OpenGL 4.5's own functions, as libOpenGL exports them. Include before any OpenSceneGraph header.
#pragma once

#ifndef GL_GLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES
#endif
#include <GL/gl.h>
#include <GL/glext.h>
