// What lies over the picture: the legend of the colours and a line of what is shown.
#ifndef DPE_VIEWER_APP_LEGEND_H_
#define DPE_VIEWER_APP_LEGEND_H_

#include "app/session.h"

namespace dpe::viewer {

// Within ImGui's frame: a bar of colours with its values and unit, lower right, if
// there is a scale; and a caption, upper right.
void DrawLegend(const Session& session);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_APP_LEGEND_H_
