// Small owners of GL objects: programs from embedded shaders, buffers, textures. All need their context to be
// current.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "render/gl/functions.h"

namespace penumbra::gl {

/// A linked program. Shader files may name others by a line `#include "name.glsl"` (one level).
class Program {
 public:
  /// What the stages find defined, `#define name value`. Software rasterizers run both sides of every branch,
  /// so what is the same for a whole draw call is better a definition than a uniform.
  struct Definition {
    std::string_view name;
    int value;
  };
  struct Stage {
    GLenum type;
    /// Name of an embedded file (shaders.h), without its folder. With a text only a name for messages.
    std::string_view file;
    /// The source itself, instead of the file's.
    std::string_view text = {};
  };
  /// Throws SystemError with the compiler's log.
  Program(const Functions& gl, std::initializer_list<Stage> stages,
          std::initializer_list<Definition> definitions = {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  void use() const { gl_.UseProgram(id_); }
  GLint uniform(const char* name) const { return gl_.GetUniformLocation(id_, name); }

 private:
  const Functions& gl_;
  GLuint id_ = 0;
};

/// Buffer, texture, framebuffer or vertex array: made on construction, deleted with its owner.
class Object {
 public:
  enum class Kind { kBuffer, kTexture, kFramebuffer, kVertexArray };
  Object(const Functions& gl, Kind kind);
  ~Object();
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  operator GLuint() const { return id_; }

 private:
  const Functions& gl_;
  Kind kind_;
  GLuint id_ = 0;
};

/// Throws SystemError if the current context reports an error or the bound framebuffer is incomplete;
/// std::bad_alloc where it reports that it lacks memory.
void require_no_error(const Functions& gl, const char* doing);
void require_complete_framebuffer(const Functions& gl, const char* doing);

}  // namespace penumbra::gl
