#include "render/gl/program.h"

#include <new>
#include <vector>

#include "penumbra/mesh/error.h"
#include "render/gl/shaders.h"

namespace penumbra::gl {
namespace {

std::string expand_includes(std::string text) {
  constexpr std::string_view kInclude = "#include \"";
  for (std::size_t at = text.find(kInclude); at != std::string::npos; at = text.find(kInclude, at)) {
    const std::size_t name = at + kInclude.size();
    const std::size_t quote = text.find('"', name);
    const std::string included(shader_source(text.substr(name, quote - name)));
    text.replace(at, quote + 1 - at, included);
    at += included.size();
  }
  return text;
}

/// Puts definitions after the line of `#version`, which has to be the first.
std::string define(std::string text, std::initializer_list<Program::Definition> definitions) {
  std::string lines;
  for (const Program::Definition& d : definitions)
    lines += "#define " + std::string(d.name) + " " + std::to_string(d.value) + "\n";
  return text.insert(text.find('\n') + 1, lines);
}

GLuint compile(const Functions& gl, const Program::Stage& stage,
               std::initializer_list<Program::Definition> definitions) {
  const std::string source(stage.text.empty() ? shader_source(stage.file) : stage.text);
  const std::string text = define(expand_includes(source), definitions);
  const char* pointer = text.c_str();
  const GLuint shader = gl.CreateShader(stage.type);
  gl.ShaderSource(shader, 1, &pointer, nullptr);
  gl.CompileShader(shader);
  GLint good = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  std::vector<char> log(4096);
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  gl.DeleteShader(shader);
  throw SystemError("shader " + std::string(stage.file) + " does not compile: " + log.data());
}

}  // namespace

Program::Program(const Functions& gl, std::initializer_list<Stage> stages,
                 std::initializer_list<Definition> definitions)
    : gl_(gl), id_(gl.CreateProgram()) {
  std::string names;
  for (const Stage& stage : stages) {
    const GLuint shader = compile(gl, stage, definitions);
    gl.AttachShader(id_, shader);
    gl.DeleteShader(shader);  // kept alive by the program
    names += std::string(stage.file) + " ";
  }
  gl.LinkProgram(id_);
  GLint good = 0;
  gl.GetProgramiv(id_, GL_LINK_STATUS, &good);
  if (good) return;
  std::vector<char> log(4096);
  gl.GetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw SystemError("shaders " + names + "do not link: " + log.data());
}

Program::~Program() {
  gl_.DeleteProgram(id_);
}

Object::Object(const Functions& gl, Kind kind) : gl_(gl), kind_(kind) {
  switch (kind) {
    case Kind::kBuffer:
      gl.GenBuffers(1, &id_);
      break;
    case Kind::kTexture:
      gl.GenTextures(1, &id_);
      break;
    case Kind::kFramebuffer:
      gl.GenFramebuffers(1, &id_);
      break;
    case Kind::kVertexArray:
      gl.GenVertexArrays(1, &id_);
      break;
  }
}

Object::~Object() {
  switch (kind_) {
    case Kind::kBuffer:
      gl_.DeleteBuffers(1, &id_);
      break;
    case Kind::kTexture:
      gl_.DeleteTextures(1, &id_);
      break;
    case Kind::kFramebuffer:
      gl_.DeleteFramebuffers(1, &id_);
      break;
    case Kind::kVertexArray:
      gl_.DeleteVertexArrays(1, &id_);
      break;
  }
}

void require_no_error(const Functions& gl, const char* doing) {
  const GLenum error = gl.GetError();
  if (error == GL_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != GL_NO_ERROR)
    throw SystemError(std::string("OpenGL error ") + std::to_string(error) + " while " + doing);
}

void require_complete_framebuffer(const Functions& gl, const char* doing) {
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  require_no_error(gl, doing);  // a texture for which there was no memory, say
  throw SystemError(std::string("OpenGL framebuffer is incomplete while ") + doing);
}

}  // namespace penumbra::gl
