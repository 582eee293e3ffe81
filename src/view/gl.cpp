// SPDX-License-Identifier: MIT
#include "view/gl.h"

#include <GL/glcorearb.h>
#include <GL/osmesa.h>
#include <dlfcn.h>
#include <sched.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

#include "base/error.h"
#include "view/render.h"

#ifdef __SANITIZE_ADDRESS__
/// Mesa keeps a few hundred bytes of each frame buffer until the process ends.
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\n"; }
#endif

namespace tunica {
namespace {

// Everything used of OpenGL 3.3 core: type of the pointer, name.
#define TUNICA_GL_FUNCTIONS(X)                                               \
  X(PFNGLATTACHSHADERPROC, AttachShader)                                     \
  X(PFNGLBINDBUFFERPROC, BindBuffer)                                         \
  X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                               \
  X(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer)                             \
  X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                               \
  X(PFNGLBLENDFUNCPROC, BlendFunc)                                           \
  X(PFNGLBLITFRAMEBUFFERPROC, BlitFramebuffer)                               \
  X(PFNGLBUFFERDATAPROC, BufferData)                                         \
  X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)                 \
  X(PFNGLCLEARPROC, Clear)                                                   \
  X(PFNGLCLEARCOLORPROC, ClearColor)                                         \
  X(PFNGLCOMPILESHADERPROC, CompileShader)                                   \
  X(PFNGLCREATEPROGRAMPROC, CreateProgram)                                   \
  X(PFNGLCREATESHADERPROC, CreateShader)                                     \
  X(PFNGLDEPTHFUNCPROC, DepthFunc)                                           \
  X(PFNGLDISABLEPROC, Disable)                                               \
  X(PFNGLDRAWARRAYSPROC, DrawArrays)                                         \
  X(PFNGLENABLEPROC, Enable)                                                 \
  X(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray)               \
  X(PFNGLFINISHPROC, Finish)                                                 \
  X(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer)               \
  X(PFNGLGENBUFFERSPROC, GenBuffers)                                         \
  X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                               \
  X(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers)                             \
  X(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                               \
  X(PFNGLGETERRORPROC, GetError)                                             \
  X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                     \
  X(PFNGLGETSTRINGPROC, GetString)                                           \
  X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                         \
  X(PFNGLLINKPROGRAMPROC, LinkProgram)                                       \
  X(PFNGLPIXELSTOREIPROC, PixelStorei)                                       \
  X(PFNGLREADPIXELSPROC, ReadPixels)                                         \
  X(PFNGLRENDERBUFFERSTORAGEPROC, RenderbufferStorage)                       \
  X(PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC, RenderbufferStorageMultisample) \
  X(PFNGLSCISSORPROC, Scissor)                                               \
  X(PFNGLSHADERSOURCEPROC, ShaderSource)                                     \
  X(PFNGLUNIFORM4FPROC, Uniform4f)                                           \
  X(PFNGLUSEPROGRAMPROC, UseProgram)                                         \
  X(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)                       \
  X(PFNGLVIEWPORTPROC, Viewport)

/// OSMesa and OpenGL as found at run time. Never unloaded: its threads and exit handlers outlive any use of ours.
struct Library {
  decltype(&OSMesaCreateContextAttribs) create = nullptr;
  decltype(&OSMesaMakeCurrent) make_current = nullptr;
  decltype(&OSMesaDestroyContext) destroy = nullptr;
  decltype(&OSMesaGetProcAddress) address = nullptr;
};

/// llvmpipe starts a thread for every core of the machine unless told otherwise, and reads this once: a run that was
/// given 2 cores of a 128-core node should start 2.
void limit_threads() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  setenv("LP_NUM_THREADS", std::to_string(std::clamp(CPU_COUNT(&allowed), 1, 8)).c_str(), 0);
}

Library load_library() {
  limit_threads();
  void* handle = nullptr;
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"})
    if (!handle) handle = dlopen(name, RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    const char* reason = dlerror();
    fail("cannot draw: the off-screen renderer OSMesa is not installed (Debian: apt-get install libosmesa6); {}",
         reason ? reason : "");
  }
  Library library;
  const auto find = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(handle, name));
    if (!function) fail("cannot draw: the OSMesa library found has no {}; version 11 or later is needed", name);
  };
  find(library.create, "OSMesaCreateContextAttribs");
  find(library.make_current, "OSMesaMakeCurrent");
  find(library.destroy, "OSMesaDestroyContext");
  find(library.address, "OSMesaGetProcAddress");
  return library;
}

const Library& library() {
  static const Library loaded = load_library();
  return loaded;
}

constexpr const char* vertex_source = R"(#version 330 core
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 colour;
uniform vec4 tile;  // origin and size in pixels
out vec4 premultiplied;
void main() {
  vec2 p = (place.xy - tile.xy) / tile.zw * 2.0 - 1.0;
  gl_Position = vec4(p, place.z * 2.0 - 1.0, 1.0);
  premultiplied = vec4(colour.rgb * colour.a, colour.a);
})";

constexpr const char* fragment_source = R"(#version 330 core
in vec4 premultiplied;
out vec4 result;
void main() { result = premultiplied; })";

constexpr int oversampling = 2;  ///< renderer's pixels per picture pixel, each way
constexpr int tile_side = 1024;  ///< picture pixels: bounds memory (about 150 MB) whatever the picture's size
constexpr int samples = 4;       ///< llvmpipe's most

/// Triangles that follow each other, with the pixels they may touch: a tile draws only those that reach it.
struct Chunk {
  GLint first;
  GLsizei count;
  float left, top, right, bottom;
};

std::vector<Chunk> chunks_of(const std::vector<Vertex>& triangles) {
  constexpr size_t size = 3 * 1024;
  std::vector<Chunk> chunks;
  for (size_t first = 0; first < triangles.size(); first += size) {
    const size_t last = std::min(first + size, triangles.size());
    Chunk chunk{
        static_cast<GLint>(first), static_cast<GLsizei>(last - first), INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t i = first; i < last; ++i) {
      chunk.left = std::min(chunk.left, triangles[i].x), chunk.right = std::max(chunk.right, triangles[i].x);
      chunk.top = std::min(chunk.top, triangles[i].y), chunk.bottom = std::max(chunk.bottom, triangles[i].y);
    }
    chunks.push_back(chunk);
  }
  return chunks;
}

/// A context with its program and buffers; belongs to one thread.
class Context {
 public:
  Context() {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              24,
                              OSMESA_STENCIL_BITS,
                              0,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              3,
                              0};
    context_ = library().create(attributes, nullptr);
    if (!context_) fail("cannot draw: OSMesa gives no OpenGL 3.3 context");
    make_current();
#define TUNICA_LOAD(type, name)                                 \
  name = reinterpret_cast<type>(library().address("gl" #name)); \
  if (!name) fail("cannot draw: OSMesa has no OpenGL function gl" #name);
    TUNICA_GL_FUNCTIONS(TUNICA_LOAD)
#undef TUNICA_LOAD
    renderer_ = reinterpret_cast<const char*>(GetString(GL_RENDERER));
    build_program();
    build_vertices();
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { library().destroy(context_); }

  /// A host may have made another context current since.
  void make_current() {
    if (!library().make_current(context_, dummy_, GL_UNSIGNED_BYTE, 4, 4))
      fail("cannot draw: OSMesa cannot make its context current");
  }
  const char* renderer() const { return renderer_.c_str(); }

  void draw(int width, int height, const Colour& background, const TriangleList& triangles, const CancelFlag* cancel,
            std::vector<uint8_t>& pixels) {
    const auto solid = static_cast<GLsizei>(triangles.solid.size()), upon = static_cast<GLsizei>(triangles.upon.size());
    const auto bytes = static_cast<GLsizeiptr>(sizeof(Vertex));
    const std::vector<Chunk> chunks = chunks_of(triangles.solid);
    const EmptyAfterwards empty{*this};
    BindVertexArray(arrays_[0]);
    BindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
    BufferData(GL_ARRAY_BUFFER, solid * bytes, triangles.solid.data(), GL_STREAM_DRAW);
    BindBuffer(GL_ARRAY_BUFFER, buffers_[1]);
    BufferData(GL_ARRAY_BUFFER, upon * bytes, triangles.upon.data(), GL_STREAM_DRAW);
    UseProgram(program_);
    Enable(GL_BLEND);
    // Colours are premultiplied from the shader on: coverage averages and stacks rightly upon a transparent ground.
    BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    Enable(GL_MULTISAMPLE);
    DepthFunc(GL_LEQUAL);
    for (int y = 0; y < height; y += tile_side) {
      for (int x = 0; x < width; x += tile_side) {
        const int w = std::min(tile_side, width - x), h = std::min(tile_side, height - y);
        begin_tile(w, h, background);
        Uniform4f(tile_, static_cast<float>(x), static_cast<float>(y), static_cast<float>(w), static_cast<float>(h));
        Enable(GL_DEPTH_TEST);
        Enable(GL_SCISSOR_TEST);
        clip(triangles, x, y, w, h);
        BindVertexArray(arrays_[0]);
        for (const Chunk& chunk : chunks) {
          poll(cancel);
          if (chunk.right >= x && chunk.left <= x + w && chunk.bottom >= y && chunk.top <= y + h)
            DrawArrays(GL_TRIANGLES, chunk.first, chunk.count);
        }
        Disable(GL_DEPTH_TEST);
        Disable(GL_SCISSOR_TEST);
        BindVertexArray(arrays_[1]);
        DrawArrays(GL_TRIANGLES, 0, upon);
        end_tile(x, y, w, h, width, pixels);
      }
    }
    if (const GLenum error = GetError(); error != GL_NO_ERROR)
      fail("cannot draw: OpenGL reports error {:#x}{}", error, error == GL_OUT_OF_MEMORY ? " (out of memory)" : "");
  }

 private:
  /// Empty buffers give the vertices' memory back; a large tissue's are tens of megabytes.
  struct EmptyAfterwards {
    Context& context;
    ~EmptyAfterwards() {
      for (const GLuint buffer : context.buffers_) {
        context.BindBuffer(GL_ARRAY_BUFFER, buffer);
        context.BufferData(GL_ARRAY_BUFFER, 0, nullptr, GL_STREAM_DRAW);
      }
    }
  };

  void build_program() {
    program_ = CreateProgram();
    for (const auto& [kind, source] :
         {std::pair{GL_VERTEX_SHADER, vertex_source}, {GL_FRAGMENT_SHADER, fragment_source}}) {
      const GLuint shader = CreateShader(static_cast<GLenum>(kind));
      ShaderSource(shader, 1, &source, nullptr);
      CompileShader(shader);
      AttachShader(program_, shader);
    }
    LinkProgram(program_);
    GLint linked = 0;
    GetProgramiv(program_, GL_LINK_STATUS, &linked);
    if (!linked) fail("cannot draw: {} does not accept the shaders", renderer_);
    tile_ = GetUniformLocation(program_, "tile");
  }

  void build_vertices() {
    GenVertexArrays(2, arrays_);
    GenBuffers(2, buffers_);
    for (int i = 0; i < 2; ++i) {
      BindVertexArray(arrays_[i]);
      BindBuffer(GL_ARRAY_BUFFER, buffers_[i]);
      VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), nullptr);
      VertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Vertex),
                          reinterpret_cast<void*>(offsetof(Vertex, r)));
      EnableVertexAttribArray(0);
      EnableVertexAttribArray(1);
    }
  }

  /// Binds the sampled frame buffer, made anew only when the size of the tile changes.
  void begin_tile(int w, int h, const Colour& background) {
    w *= oversampling, h *= oversampling;
    if (w != buffer_width_ || h != buffer_height_) resize(w, h);
    BindFramebuffer(GL_FRAMEBUFFER, frames_[0]);
    Viewport(0, 0, w, h);
    ClearColor(background.r * background.a, background.g * background.a, background.b * background.a, background.a);
    Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  }

  void clip(const TriangleList& list, int x, int y, int w, int h) {
    const int left = std::clamp(list.clip_left - x, 0, w), right = std::clamp(list.clip_right - x, left, w);
    const int top = std::clamp(list.clip_top - y, 0, h), bottom = std::clamp(list.clip_bottom - y, top, h);
    Scissor(left * oversampling, top * oversampling, (right - left) * oversampling, (bottom - top) * oversampling);
  }

  void resize(int w, int h) {
    if (!frames_[0]) {
      GenFramebuffers(2, frames_);
      GenRenderbuffers(3, stores_);
    }
    BindRenderbuffer(GL_RENDERBUFFER, stores_[0]);
    RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, w, h);
    BindRenderbuffer(GL_RENDERBUFFER, stores_[1]);
    RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, w, h);
    BindRenderbuffer(GL_RENDERBUFFER, stores_[2]);
    RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, w, h);
    BindFramebuffer(GL_FRAMEBUFFER, frames_[1]);
    FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, stores_[2]);
    BindFramebuffer(GL_FRAMEBUFFER, frames_[0]);
    FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, stores_[0]);
    FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, stores_[1]);
    if (CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      fail("cannot draw: {} gives no frame buffer of {} by {} with {} samples", renderer_, w, h, samples);
    buffer_width_ = w, buffer_height_ = h;
  }

  /// Resolves the samples, averages the renderer's pixels and puts the tile into the picture.
  void end_tile(int x0, int y0, int w, int h, int width, std::vector<uint8_t>& pixels) {
    const int fine_w = w * oversampling, fine_h = h * oversampling;
    BindFramebuffer(GL_DRAW_FRAMEBUFFER, frames_[1]);
    BlitFramebuffer(0, 0, fine_w, fine_h, 0, 0, fine_w, fine_h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    BindFramebuffer(GL_READ_FRAMEBUFFER, frames_[1]);
    fine_.resize(static_cast<size_t>(fine_w) * static_cast<size_t>(fine_h) * 4);
    PixelStorei(GL_PACK_ALIGNMENT, 4);
    ReadPixels(0, 0, fine_w, fine_h, GL_RGBA, GL_UNSIGNED_BYTE, fine_.data());
    Finish();
    const size_t stride = static_cast<size_t>(fine_w) * 4;
    for (int y = 0; y < h; ++y) {
      const uint8_t* upper = fine_.data() + static_cast<size_t>(2 * y) * stride;
      const uint8_t* lower = upper + stride;
      uint8_t* out =
          pixels.data() + 4 * (static_cast<size_t>(y0 + y) * static_cast<size_t>(width) + static_cast<size_t>(x0));
      for (int x = 0; x < w; ++x, upper += 8, lower += 8, out += 4)
        for (int c = 0; c < 4; ++c)
          out[c] = static_cast<uint8_t>((upper[c] + upper[c + 4] + lower[c] + lower[c + 4] + 2) / 4);
    }
  }

#define TUNICA_DECLARE(type, name) type name = nullptr;
  TUNICA_GL_FUNCTIONS(TUNICA_DECLARE)
#undef TUNICA_DECLARE

  OSMesaContext context_ = nullptr;
  uint8_t dummy_[4 * 4 * 4] = {};  ///< OSMesa's own buffer; drawing goes to frames_
  std::string renderer_;
  GLuint program_ = 0, arrays_[2] = {}, buffers_[2] = {}, frames_[2] = {}, stores_[3] = {};
  GLint tile_ = -1;
  int buffer_width_ = 0, buffer_height_ = 0;
  std::vector<uint8_t> fine_;
};

/// One for each thread that draws, kept: making one costs more than most pictures.
Context& context() {
  thread_local std::unique_ptr<Context> own;
  if (own) {
    own->make_current();
  } else {
    own = std::make_unique<Context>();
  }
  return *own;
}

}  // namespace

std::vector<uint8_t> rasterise(int width, int height, const Colour& background, const TriangleList& triangles,
                               const CancelFlag* cancel) {
  constexpr size_t most = size_t{1} << 30;
  if (triangles.solid.size() > most || triangles.upon.size() > most) fail("too much to draw in one picture");
  std::vector<uint8_t> pixels(static_cast<size_t>(width) * static_cast<size_t>(height) * 4);
  context().draw(width, height, background, triangles, cancel, pixels);
  return pixels;
}

const char* renderer_name() { return context().renderer(); }

}  // namespace tunica
