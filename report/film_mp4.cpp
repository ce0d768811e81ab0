#include "core/error.hpp"
#include "report/film.hpp"

#include <cerrno>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace cnem::report {

void convert_to_mp4(const std::filesystem::path& gif, const std::filesystem::path& mp4) {
  // Players want even sizes and this layout of colours; the table of contents comes first, for browsers.
  std::vector<std::string> words{"ffmpeg",     "-loglevel", "error",
                                 "-nostdin",   "-y",        "-i",
                                 gif.string(), "-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white",
                                 "-pix_fmt",   "yuv420p",   "-movflags",
                                 "+faststart", "-f",        "mp4",
                                 mp4.string()};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  const int error = posix_spawnp(&process, "ffmpeg", nullptr, nullptr, arguments.data(), environ);
  if (error == ENOENT)
    throw InputError(
        "MP4 needs ffmpeg, which is not installed (Debian: apt install ffmpeg); films that end in "
        ".gif and .webp need nothing");
  if (error != 0) throw IoError(fmt::format("cannot run ffmpeg: {}", std::system_category().message(error)));
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {}
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw IoError(fmt::format("ffmpeg could not make {}", mp4.string()));
}

} // namespace cnem::report
