// Vertices on the graphics side: three floats of place and one more attribute each.
#pragma once

#include <cstddef>
#include <vector>

#include "render/gl/program.h"

namespace penumbra::viewer {

/// Attribute 1 of a vertex, as OpenGL takes it. Attribute 0 is the place, three floats at its beginning.
struct VertexAttribute {
  GLint size;
  GLenum type;
  GLboolean normalized;
  std::size_t offset;  ///< bytes
};

struct VertexList {
  explicit VertexList(const gl::Functions& gl)
      : array(gl, gl::Object::Kind::kVertexArray), buffer(gl, gl::Object::Kind::kBuffer) {}
  gl::Object array, buffer;
  GLsizei count = 0;
};

/// Replaces what the list's buffer holds. Returns how many vertices that is.
template <class Vertex>
GLsizei upload(const gl::Functions& gl, const VertexList& list, const std::vector<Vertex>& vertices,
               const VertexAttribute& more) {
  gl.BindVertexArray(list.array);
  gl.BindBuffer(GL_ARRAY_BUFFER, list.buffer);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
                GL_DYNAMIC_DRAW);
  gl.EnableVertexAttribArray(0);
  gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), nullptr);
  gl.EnableVertexAttribArray(1);
  gl.VertexAttribPointer(1, more.size, more.type, more.normalized, sizeof(Vertex),
                         reinterpret_cast<const void*>(more.offset));
  gl.BindVertexArray(0);
  return static_cast<GLsizei>(vertices.size());
}

}  // namespace penumbra::viewer
