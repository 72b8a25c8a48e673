# embed.cmake - writes files as arrays of C:
#     cmake -DOUTPUT=FILE.c -DFILES=a.js,b.css -DTHREE=three.min.js -P embed.cmake
# Each file is found by its name without the ending. THREE may be empty: then the array "three" has no bytes.
string(REPLACE "," ";" files "${FILES}")
set(arrays)
set(rows)
function(add name path)
  set(bytes)
  set(length 0)
  if(path)
    file(READ "${path}" hex HEX)
    string(LENGTH "${hex}" length)
    math(EXPR length "${length} / 2")
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  endif()
  file(APPEND "${OUTPUT}.new" "static const unsigned char file_${name}[] = {${bytes}0};\n")
  set(rows "${rows}    {\"${name}\", file_${name}, ${length}},\n" PARENT_SCOPE)
endfunction()
file(WRITE "${OUTPUT}.new" "/* Made by apps/isoroll/view/embed.cmake. */
#include <string.h>

#include \"view.h\"

")
foreach(path IN LISTS files)
  get_filename_component(name "${path}" NAME_WE)
  add(${name} "${path}")
endforeach()
add(three "${THREE}")
file(APPEND "${OUTPUT}.new" "
const view_file view_files[] = {
${rows}    {NULL, NULL, 0},
};

const view_file *view_file_find(const char *name)
{
    const view_file *file = view_files;
    while (file->name && strcmp(file->name, name) != 0) file++;
    return file;
}
")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
