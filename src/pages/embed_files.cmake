# Compiles the files of a page into the library: its style, its scripts and the libraries that they use. A changed file is
# embedded again by the next build.
#
# Included by CMakeLists.txt, it adds the command; run by that command, as a script, it writes OUTPUT.
set(carom_page_files page/page.css page/errors.js page/theme.js page/numbers.js page/traces.js page/layout.js
    page/export.js page/embedded.js page/field_film.js page/page.js plotly/plotly-basic.min.js plotly/LICENSE
    delaunator/delaunator.min.js delaunator/LICENSE
    player/player.html player/player.css player/run.html player/recording.js player/flights.js player/samples.js player/measures.js
    player/hexatic.js player/scales.js player/palettes.js player/settings.js player/view.js player/trails.js player/raster.js player/drawing.js
    player/readings.js player/legend.js player/plots.js player/clock.js player/controls.js player/keyboard.js player/pointer.js
    player/panel.js player/player.js
    side_by_side/side_by_side.html side_by_side/sides.js side_by_side/distances.js side_by_side/overlaps.js side_by_side/curves.js
    side_by_side/panel.js)

if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(carom_embedded ${CMAKE_CURRENT_BINARY_DIR}/pages/embedded_texts.cpp)
  list(TRANSFORM carom_page_files PREPEND ${CMAKE_CURRENT_LIST_DIR}/ OUTPUT_VARIABLE carom_page_paths)
  add_custom_command(OUTPUT ${carom_embedded} VERBATIM COMMENT "Embedding the files of a page"
                     COMMAND ${CMAKE_COMMAND} -D OUTPUT=${carom_embedded} -P ${CMAKE_CURRENT_LIST_FILE}
                     DEPENDS ${carom_page_paths} ${CMAKE_CURRENT_LIST_FILE})
  target_sources(carom_pages PRIVATE ${carom_embedded})
  return()
endif()

# Clang warns of literals beyond 65536 bytes. A piece ends after a semicolon where it can, never inside a character.
cmake_minimum_required(VERSION 3.25)
set(longest_piece 60000)
set(arrays "")
set(entries "")
set(index 0)
foreach(name IN LISTS carom_page_files)
  file(READ ${CMAKE_CURRENT_LIST_DIR}/${name} text)
  string(LENGTH "${text}" length)
  set(begin 0)
  set(pieces "")
  while(begin LESS length)
    string(SUBSTRING "${text}" ${begin} ${longest_piece} piece)
    math(EXPR left "${length} - ${begin}")
    if(left GREATER longest_piece)
      string(FIND "${piece}" ";" last REVERSE)
      if(last LESS 0)
        message(FATAL_ERROR "${name}: no semicolon within ${longest_piece} bytes, so no place to cut")
      endif()
      math(EXPR end "${last} + 1")
      string(SUBSTRING "${piece}" 0 ${end} piece)
    endif()
    string(LENGTH "${piece}" piece_length)
    math(EXPR begin "${begin} + ${piece_length}")
    string(APPEND pieces "    R\"carom_embeds(${piece})carom_embeds\"sv,\n")
  endwhile()
  string(APPEND arrays "constexpr std::string_view pieces_${index}[] = {\n${pieces}};\n")
  string(APPEND entries "    {\"${name}\", pieces_${index}},\n")
  math(EXPR index "${index} + 1")
endforeach()
file(WRITE ${OUTPUT} "// Written by embed_files.cmake from src/pages.
#include \"pages/html_parts.hpp\"

namespace carom::detail {
namespace {

using namespace std::string_view_literals;  // which know their lengths: no compiler counts a megabyte

${arrays}
constexpr EmbeddedFile files[] = {
${entries}};

}  // namespace

std::span<const EmbeddedFile> embedded_files() { return files; }

}  // namespace carom::detail
")
