// How different two pictures are to the eye.
//
// Drivers differ in which samples an edge covers and in the last bit of a color.
// Neither is seen, so both pictures are averaged over blocks of 8 x 8 pixels first.
// What is left is measured as CIE 1976 color difference, sqrt(dL^2 + da^2 + db^2) in
// L*a*b* (D65), of which 2.3 is just noticed; L* of black and white differ by 100.
#ifndef DPE_TESTS_VIEWER_PICTURE_DIFFERENCE_H_
#define DPE_TESTS_VIEWER_PICTURE_DIFFERENCE_H_

#include <gtest/gtest.h>

#include <string>

#include "png/image.h"

namespace dpe::viewer {

struct PictureDifference {
  double mean = 0.0;     // over the blocks
  double largest = 0.0;  // of a block
};

// Both of the same size.
PictureDifference Compare(const Image& a, const Image& b);

// What is taken for the same picture. render_reference_test.cc checks that what drivers
// are free to do makes at most half of both, and that mistakes make at least twice one
// of them.
constexpr PictureDifference kAlike{0.25, 6.0};
bool AreAlike(const PictureDifference& difference);

// Compares with tests/viewer/references/<name>.png. On failure says where the picture
// that was drawn is kept. With DPE_WRITE_REFERENCES=1 it becomes the reference.
::testing::AssertionResult MatchesReference(const Image& image,
                                            const std::string& name);

// The reference itself.
Image Reference(const std::string& name);

}  // namespace dpe::viewer

#endif  // DPE_TESTS_VIEWER_PICTURE_DIFFERENCE_H_
