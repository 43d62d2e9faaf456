// Scenes from scratch: presets, grids and meshes.
#ifndef DPE_PYTHON_SCENE_BUILDERS_H_
#define DPE_PYTHON_SCENE_BUILDERS_H_

#include <pybind11/pybind11.h>

#include <memory>

#include "dpe/engine/scene.h"

namespace dpe::python {

using SceneClass = pybind11::class_<Scene, std::shared_ptr<Scene>>;

void BindSceneBuilders(SceneClass* type);

}  // namespace dpe::python

#endif  // DPE_PYTHON_SCENE_BUILDERS_H_
