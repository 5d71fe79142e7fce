# carom_embed_texts(TARGET FUNCTION FILES...) compiles text files into TARGET, where carom::detail::FUNCTION() returns them as
# EmbeddedText (text/embedded_text.hpp). FILES are paths below the source tree. The next build embeds a changed file again.
function(carom_embed_texts target function)
  set(entries "")
  foreach(path IN LISTS ARGN)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${path})
    file(READ ${PROJECT_SOURCE_DIR}/${path} text)
    string(APPEND entries "    {\"${path}\", R\"embedded(${text})embedded\"},\n")
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${function}.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [=[
// Written by embed_texts.cmake.
#include "text/embedded_text.hpp"

namespace carom::detail {

std::span<const EmbeddedText> @function@();
std::span<const EmbeddedText> @function@() {
  static constexpr EmbeddedText texts[] = {
@entries@  };
  return texts;
}

}  // namespace carom::detail
]=])
  target_sources(${target} PRIVATE ${source})
endfunction()
