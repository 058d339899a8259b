// The OpenGL functions that Penumbra calls, as a table per context.
//
// Loaders with global tables fail here: one aborts on OSMesa contexts, others silently do nothing. A table
// per context, filled through that backend's own GetProcAddress, lets several backends live in one process.
#pragma once

#include <GL/glcorearb.h>

namespace penumbra::gl {

using ProcLoader = void* (*)(const char* name);

// One line a function: its name without "gl", its pointer type.
#define PENUMBRA_GL_FUNCTIONS(X)                               \
  X(ActiveTexture, PFNGLACTIVETEXTUREPROC)                     \
  X(AttachShader, PFNGLATTACHSHADERPROC)                       \
  X(BindBuffer, PFNGLBINDBUFFERPROC)                           \
  X(BindBufferBase, PFNGLBINDBUFFERBASEPROC)                   \
  X(BindFramebuffer, PFNGLBINDFRAMEBUFFERPROC)                 \
  X(BindTexture, PFNGLBINDTEXTUREPROC)                         \
  X(BindVertexArray, PFNGLBINDVERTEXARRAYPROC)                 \
  X(BufferData, PFNGLBUFFERDATAPROC)                           \
  X(CheckFramebufferStatus, PFNGLCHECKFRAMEBUFFERSTATUSPROC)   \
  X(ClearBufferfv, PFNGLCLEARBUFFERFVPROC)                     \
  X(ClearBufferiv, PFNGLCLEARBUFFERIVPROC)                     \
  X(ClearBufferuiv, PFNGLCLEARBUFFERUIVPROC)                   \
  X(ClipControl, PFNGLCLIPCONTROLPROC)                         \
  X(ColorMask, PFNGLCOLORMASKPROC)                             \
  X(CompileShader, PFNGLCOMPILESHADERPROC)                     \
  X(CopyImageSubData, PFNGLCOPYIMAGESUBDATAPROC)               \
  X(CullFace, PFNGLCULLFACEPROC)                               \
  X(CreateProgram, PFNGLCREATEPROGRAMPROC)                     \
  X(CreateShader, PFNGLCREATESHADERPROC)                       \
  X(DeleteBuffers, PFNGLDELETEBUFFERSPROC)                     \
  X(DeleteFramebuffers, PFNGLDELETEFRAMEBUFFERSPROC)           \
  X(DeleteProgram, PFNGLDELETEPROGRAMPROC)                     \
  X(DeleteShader, PFNGLDELETESHADERPROC)                       \
  X(DeleteTextures, PFNGLDELETETEXTURESPROC)                   \
  X(DeleteVertexArrays, PFNGLDELETEVERTEXARRAYSPROC)           \
  X(DepthFunc, PFNGLDEPTHFUNCPROC)                             \
  X(DepthMask, PFNGLDEPTHMASKPROC)                             \
  X(Disable, PFNGLDISABLEPROC)                                 \
  X(DrawArrays, PFNGLDRAWARRAYSPROC)                           \
  X(DrawBuffers, PFNGLDRAWBUFFERSPROC)                         \
  X(DrawElements, PFNGLDRAWELEMENTSPROC)                       \
  X(DrawElementsInstanced, PFNGLDRAWELEMENTSINSTANCEDPROC)     \
  X(Enable, PFNGLENABLEPROC)                                   \
  X(EnableVertexAttribArray, PFNGLENABLEVERTEXATTRIBARRAYPROC) \
  X(Finish, PFNGLFINISHPROC)                                   \
  X(Flush, PFNGLFLUSHPROC)                                     \
  X(FramebufferTextureLayer, PFNGLFRAMEBUFFERTEXTURELAYERPROC) \
  X(FramebufferTexture2D, PFNGLFRAMEBUFFERTEXTURE2DPROC)       \
  X(GenBuffers, PFNGLGENBUFFERSPROC)                           \
  X(GenFramebuffers, PFNGLGENFRAMEBUFFERSPROC)                 \
  X(GenTextures, PFNGLGENTEXTURESPROC)                         \
  X(GenVertexArrays, PFNGLGENVERTEXARRAYSPROC)                 \
  X(GetError, PFNGLGETERRORPROC)                               \
  X(GetIntegerv, PFNGLGETINTEGERVPROC)                         \
  X(GetProgramInfoLog, PFNGLGETPROGRAMINFOLOGPROC)             \
  X(GetProgramiv, PFNGLGETPROGRAMIVPROC)                       \
  X(GetShaderInfoLog, PFNGLGETSHADERINFOLOGPROC)               \
  X(GetShaderiv, PFNGLGETSHADERIVPROC)                         \
  X(GetString, PFNGLGETSTRINGPROC)                             \
  X(GetUniformLocation, PFNGLGETUNIFORMLOCATIONPROC)           \
  X(LinkProgram, PFNGLLINKPROGRAMPROC)                         \
  X(LogicOp, PFNGLLOGICOPPROC)                                 \
  X(PixelStorei, PFNGLPIXELSTOREIPROC)                         \
  X(ReadBuffer, PFNGLREADBUFFERPROC)                           \
  X(ReadPixels, PFNGLREADPIXELSPROC)                           \
  X(ShaderSource, PFNGLSHADERSOURCEPROC)                       \
  X(StencilFunc, PFNGLSTENCILFUNCPROC)                         \
  X(StencilOpSeparate, PFNGLSTENCILOPSEPARATEPROC)             \
  X(TexBuffer, PFNGLTEXBUFFERPROC)                             \
  X(TexImage2D, PFNGLTEXIMAGE2DPROC)                           \
  X(TexParameteri, PFNGLTEXPARAMETERIPROC)                     \
  X(TexStorage2D, PFNGLTEXSTORAGE2DPROC)                       \
  X(TexStorage3D, PFNGLTEXSTORAGE3DPROC)                       \
  X(TexSubImage2D, PFNGLTEXSUBIMAGE2DPROC)                     \
  X(Uniform1f, PFNGLUNIFORM1FPROC)                             \
  X(Uniform1i, PFNGLUNIFORM1IPROC)                             \
  X(Uniform1ui, PFNGLUNIFORM1UIPROC)                           \
  X(Uniform2f, PFNGLUNIFORM2FPROC)                             \
  X(Uniform3f, PFNGLUNIFORM3FPROC)                             \
  X(Uniform4fv, PFNGLUNIFORM4FVPROC)                           \
  X(UniformMatrix3fv, PFNGLUNIFORMMATRIX3FVPROC)               \
  X(UniformMatrix4fv, PFNGLUNIFORMMATRIX4FVPROC)               \
  X(UseProgram, PFNGLUSEPROGRAMPROC)                           \
  X(VertexAttribIPointer, PFNGLVERTEXATTRIBIPOINTERPROC)       \
  X(VertexAttribPointer, PFNGLVERTEXATTRIBPOINTERPROC)         \
  X(Viewport, PFNGLVIEWPORTPROC)

struct Functions {
#define PENUMBRA_GL_MEMBER(name, type) type name = nullptr;
  PENUMBRA_GL_FUNCTIONS(PENUMBRA_GL_MEMBER)
#undef PENUMBRA_GL_MEMBER
};

/// Fills the table; the context must be current. Throws SystemError for a version below 4.5 (a non-null
/// pointer proves nothing: some loaders invent one for any name) or a missing function.
Functions load_functions(ProcLoader loader);

}  // namespace penumbra::gl
