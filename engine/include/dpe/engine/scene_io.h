// Reading, validating and writing scene files (JSON; the legacy extension is .txt).
#ifndef DPE_ENGINE_SCENE_IO_H_
#define DPE_ENGINE_SCENE_IO_H_

#include <string>
#include <vector>

#include "dpe/engine/export.h"
#include "dpe/engine/scene.h"

namespace dpe {

// Reads and validates a scene file.
//
// @param path      file to read; // comments are accepted in it
// @param warnings  if not null, receives one line per thing that is accepted but worth
//                  a look (unknown keys, triangles without drag, ...)
// @throws SceneError naming file, JSON path, value and what is accepted.
DPE_ENGINE_API Scene LoadScene(const std::string& path,
                               std::vector<std::string>* warnings = nullptr);

// As LoadScene, from text; `name` stands for the file in messages.
DPE_ENGINE_API Scene ParseScene(const std::string& text, const std::string& name,
                                std::vector<std::string>* warnings = nullptr);

// Checks a scene that was built in memory; the same checks as for a file.
// @param scene     to check
// @param name      stands for the file in messages
// @param warnings  as for LoadScene
// @throws SceneError naming place, value and what is accepted
DPE_ENGINE_API void ValidateScene(const Scene& scene, const std::string& name,
                                  std::vector<std::string>* warnings = nullptr);

// The scene as JSON text that LoadScene reads back to the same numbers, bit by bit.
DPE_ENGINE_API std::string SceneToJson(const Scene& scene);

// Writes SceneToJson to a temporary name beside `path` and renames it.
// @throws SceneError if the file cannot be written; `path` is then unchanged.
DPE_ENGINE_API void SaveScene(const Scene& scene, const std::string& path);

// Writes `content` to a temporary name in the same folder, then renames it to `path`,
// so that a reader sees the old file or the new one and never half of one.
// @throws SceneError naming the path and the operating system's reason.
DPE_ENGINE_API void WriteFileAtomically(const std::string& path,
                                        const std::string& content);

}  // namespace dpe

#endif  // DPE_ENGINE_SCENE_IO_H_
