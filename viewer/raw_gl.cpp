#include "viewer/raw_gl.hpp"

#include "assets/shaders/shaders.hpp"

namespace vicus::viewer {

GlStateGuard::GlStateGuard() {
  glPushAttrib(GL_ALL_ATTRIB_BITS);
  glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertexArray_);
  glGetIntegerv(GL_ARRAY_BUFFER_BINDING, &arrayBuffer_);
  glGetIntegerv(GL_ACTIVE_TEXTURE, &activeTexture_);
  glActiveTexture(GL_TEXTURE0);
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &texture_);
}

GlStateGuard::~GlStateGuard() {
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(texture_));
  glActiveTexture(static_cast<GLenum>(activeTexture_));
  glBindBuffer(GL_ARRAY_BUFFER, static_cast<GLuint>(arrayBuffer_));
  glBindVertexArray(static_cast<GLuint>(vertexArray_));
  glUseProgram(static_cast<GLuint>(program_));
  glPopAttrib();
}

namespace {

GLuint compile(GLenum kind, std::string_view file, std::string& error) {
  const std::string source = assets::shaderSource(file, {});
  const char* text = source.c_str();
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  char log[1024] = "";
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  error = std::string(file) + ": " + log;
  glDeleteShader(shader);
  return 0;
}

}  // namespace

GLuint linkProgram(std::string_view vertexFile, std::string_view fragmentFile, std::string& error) {
  const GLuint vertex = compile(GL_VERTEX_SHADER, vertexFile, error);
  const GLuint fragment = vertex != 0 ? compile(GL_FRAGMENT_SHADER, fragmentFile, error) : 0;
  GLuint program = 0;
  if (fragment != 0) {
    program = glCreateProgram();
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    glLinkProgram(program);
    GLint good = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (good != GL_TRUE) {
      char log[1024] = "";
      glGetProgramInfoLog(program, sizeof log, nullptr, log);
      error = std::string(vertexFile) + " + " + std::string(fragmentFile) + ": " + log;
      glDeleteProgram(program);
      program = 0;
    }
  }
  if (vertex != 0) glDeleteShader(vertex);
  if (fragment != 0) glDeleteShader(fragment);
  return program;
}

}  // namespace vicus::viewer
