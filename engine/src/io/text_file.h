// Whole files into memory, with errors that say what is wrong with the file.
#ifndef DPE_ENGINE_SRC_IO_TEXT_FILE_H_
#define DPE_ENGINE_SRC_IO_TEXT_FILE_H_

#include <cstdint>
#include <string>

namespace dpe {

// A cloth of 192 x 192 vertices takes 14 MB as a scene file; a file larger than this is
// a mistake, and what is made of it in memory would need tens of gigabytes.
inline constexpr std::uintmax_t kMaxFileSize = std::uintmax_t{256} << 20;  // bytes

// The content of a regular file of at most kMaxFileSize.
// @param expected  "a scene file", for messages
// @throws SceneError if it does not exist, is a folder or a device, is larger (decided
//         before anything is read), or cannot be read
std::string ReadTextFile(const std::string& path, const std::string& expected);

}  // namespace dpe

#endif  // DPE_ENGINE_SRC_IO_TEXT_FILE_H_
