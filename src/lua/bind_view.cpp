// SPDX-License-Identifier: MIT
// Pictures of tissues: as bytes, as movies, in a terminal.
#include <sys/ioctl.h>
#include <unistd.h>

#include <memory>

#include "lua/bind_tissue.h"
#include "lua/surroundings_table.h"
#include "lua/terminal_reply.h"
#include "lua/view_settings.h"
#include "view/gnuplot.h"
#include "view/movie.h"
#include "view/png.h"
#include "view/render.h"
#include "view/terminal.h"

namespace tunica::lua {
namespace {

/// draw(tissue, settings [, texts]) -> bytes of a PNG, width, height, what is around its content (for terminal_picture)
int draw(lua_State* L) {
  return guard(L, [&] {
    Tissue& tissue = tissue_at(L, 1);
    lua_settop(L, 3);
    const PngTexts texts = read_picture_texts(L, 3);
    ViewSettings settings = read_view_settings(L, tissue, 2);
    const CancelFlag* cancel = settings.cancel = &host(L).cancel;
    const Scene scene = scene_of(tissue, settings);
    const Picture picture = render(scene);
    const std::string png = encode_png(picture, texts, cancel);
    lua_pushlstring(L, png.data(), png.size());
    lua_pushinteger(L, picture.width);
    lua_pushinteger(L, picture.height);
    push_surroundings(L, surroundings_of(scene));
    return 4;
  });
}

/// renderer() -> its name, or nil and why there is none
int renderer(lua_State* L) {
  return guard(L, [&] {
    try {
      lua_pushstring(L, renderer_name());
      return 1;
    } catch (const Error& error) {
      lua_pushnil(L);
      lua_pushstring(L, error.what());
      return 2;
    }
  });
}

/// palettes() -> list of names
int palettes(lua_State* L) {
  return guard(L, [&] {
    const auto names = palette_names();
    lua_createtable(L, static_cast<int>(names.size()), 0);
    for (size_t i = 0; i < names.size(); ++i) {
      lua_pushstring(L, names[i].c_str());
      lua_rawseti(L, -2, static_cast<int>(i) + 1);
    }
    return 1;
  });
}

/// is_colour(text) -> true, or false and what is wrong
int is_colour(lua_State* L) {
  return guard(L, [&] {
    try {
      parse_colour(check_string(L, 1, "a colour"));
    } catch (const Error& error) {
      lua_pushboolean(L, 0);
      lua_pushstring(L, error.what());
      return 2;
    }
    lua_pushboolean(L, 1);
    return 1;
  });
}

// === Movies: a userdata that owns the film being written

constexpr const char* movie_type = "tunica.movie";

std::unique_ptr<Movie>& movie_at(lua_State* L, int at) {
  luaL_getmetatable(L, movie_type);
  const bool is_movie = lua_type(L, at) == LUA_TUSERDATA && lua_getmetatable(L, at) && lua_rawequal(L, -1, -2);
  lua_settop(L, is_movie ? lua_gettop(L) - 2 : lua_gettop(L) - 1);
  if (!is_movie) fail("expected a movie, came {}", describe(L, at));
  return *static_cast<std::unique_ptr<Movie>*>(lua_touserdata(L, at));
}

int collect_movie(lua_State* L) {
  std::destroy_at(static_cast<std::unique_ptr<Movie>*>(lua_touserdata(L, 1)));
  return 0;
}

/// movie(path, frames per second) -> movie
int movie(lua_State* L) {
  return guard(L, [&] {
    auto made = std::make_unique<Movie>(check_string(L, 1, "the movie's path"),
                                        lua_isnoneornil(L, 2) ? 24 : check_number(L, 2, "frames per second"));
    new (lua_newuserdata(L, sizeof(std::unique_ptr<Movie>))) std::unique_ptr<Movie>(std::move(made));
    if (luaL_newmetatable(L, movie_type)) {
      lua_pushcfunction(L, collect_movie);
      lua_setfield(L, -2, "__gc");
      lua_pushliteral(L, "movie");
      lua_setfield(L, -2, "__metatable");
    }
    lua_setmetatable(L, -2);
    return 1;
  });
}

/// movie_add(movie, bytes of a PNG)
int movie_add(lua_State* L) {
  return guard(L, [&] {
    auto& film = movie_at(L, 1);
    if (!film) fail("the movie is finished; nothing can be added");
    film->add(decode_png(check_string(L, 2, "a picture")));
    return 0;
  });
}

/// movie_finish(movie) -> number of pictures
int movie_finish(lua_State* L) {
  return guard(L, [&] {
    auto& film = movie_at(L, 1);
    if (!film) fail("the movie is finished already");
    film->finish();
    lua_pushinteger(L, film->frames());
    film.reset();
    return 1;
  });
}

// === Charts

/// gnuplot(commands): lets gnuplot carry them out.
int gnuplot(lua_State* L) {
  return guard(L, [&] {
    run_gnuplot(check_string(L, 1, "commands"), &host(L).cancel);
    return 0;
  });
}

// === Pictures in a terminal

/// What the terminal answers; a host that keeps it is asked once, and reads the keys that were typed meanwhile.
std::string answer_of_terminal(lua_State* L) {
  TerminalTalk* talk = host(L).terminal;
  if (talk && talk->answer) return *talk->answer;
  const Reply reply = split_reply(terminal_reply(image_query()));
  if (talk) talk->answer = reply.answers, talk->typed += reply.typed;
  return reply.answers;
}

/// terminal_picture(bytes of a PNG [, what is around its content]) -> the characters that show it on standard output,
/// or nil if that cannot show one
int terminal_picture_of(lua_State* L) {
  return guard(L, [&] {
    const std::string png = check_string(L, 1, "a picture");
    const Surroundings around = read_surroundings(L, 2);
    Terminal terminal{isatty(STDOUT_FILENO) != 0, terminal_environment(), ""};
    if (terminal.is_tty && terminal.environment["TUNICA_IMAGES"].empty() &&
        choose_protocol(terminal) == ImageProtocol::blocks)
      terminal.reply = answer_of_terminal(L);
    const ImageProtocol protocol = choose_protocol(terminal);
    if (protocol == ImageProtocol::off) return 0;
    winsize size{};
    const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 0;
    const int columns = known ? std::min<int>(size.ws_col, 100) : 80, rows = known ? std::max(4, size.ws_row - 2) : 40;
    const std::string text = terminal_picture(decode_png(png), around, protocol, terminal, columns, std::min(rows, 50));
    lua_pushlstring(L, text.data(), text.size());
    return 1;
  });
}

}  // namespace

void register_view(lua_State* L) {
  const luaL_Reg functions[] = {{"draw", draw},
                                {"renderer", renderer},
                                {"palettes", palettes},
                                {"is_colour", is_colour},
                                {"movie", movie},
                                {"movie_add", movie_add},
                                {"movie_finish", movie_finish},
                                {"gnuplot", gnuplot},
                                {"terminal_picture", terminal_picture_of},
                                {nullptr, nullptr}};
  add_functions(L, functions);
}

}  // namespace tunica::lua
