# Writes the files of the library of materials into a C++ file: OUTPUT from FILES (a list, all in one folder). The program carries
# them in itself: there is nothing to install beside it and nothing to find.
set(names "")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME_WLE)
  get_filename_component(folder ${file} DIRECTORY)
  list(APPEND names ${name})
endforeach()
list(SORT names)
set(entries "")
foreach(name ${names})
  file(READ ${folder}/${name}.toml text)
  string(APPEND entries "    {\"${name}\", R\"toml(${text})toml\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"input/library.hpp\"

namespace cnem::input {

std::span<const LibraryFile> library_files() {
  static constexpr LibraryFile files[] = {
${entries}  };
  return files;
}

} // namespace cnem::input
")
