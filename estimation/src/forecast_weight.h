// Which of two forecasts is better, and whether that is more than noise.
//
// Let r and q be the residuals (forecast minus observation, in standard deviations
// where the noise is known) of a simpler and of a richer model on held-out frames, and
// D = r - q the difference of the forecasts, in which the observations cancel. Of all
// mixtures of the two, (1 - w) r + w q = r - w D, the best is
//
//   w = r.D / D.D,     r = w D + u,  u.D = 0,
//
// which is 0 where the simpler forecast needs nothing of the richer, 1 where it is the
// other way round (Bates and Granger, The combination of forecasts, 1969; Harvey,
// Leybourne and Newbold, Tests for forecast encompassing, 1998). And
//
//   |r|^2 - |q|^2 = D.(r + q) = 2 (w - 1/2) |D|^2:
//
// the richer forecast is better exactly if w > 1/2. The observations' noise is in u, so
// that the standard deviation of w comes from the data alone, whether or not the size
// of the noise is known, and w is a pure number. It is the larger of
//
//   white noise:   s^2 = u.u / (n - 1) / D.D
//   noise that neighbouring frames share, in B blocks b of consecutive frames
//   (Liang and Zeger, Longitudinal data analysis using generalized linear models,
//   1986):
//                  s^2 = B / (B - 1) sum_b (D_b.u_b)^2 / (D.D)^2
//
// (which is a quarter too small where neighbouring frames' noise correlates by 0.6, and
// honest where it does not: forecast_weight_test.cc).
//
// Squared errors themselves, averaged over blocks, would do worse: a wrong model's
// error grows with time, and its growth would count as scatter. Here that is part of
// w D. The fits' own errors from noise in the fitted frames are in r and q as they are:
// badly determined parameters make D large in a direction that r does not have, w goes
// to 0, and the simpler model stays.
#ifndef DPE_ESTIMATION_FORECAST_WEIGHT_H_
#define DPE_ESTIMATION_FORECAST_WEIGHT_H_

#include <Eigen/Core>
#include <vector>

namespace dpe {

struct ForecastWeight {
  double weight = 0.0;  // w; 0 if the forecasts are the same
  double deviation = 0.0;

  // True if the richer forecast is better by more than two deviations.
  bool RicherIsBetter() const;
};

// @param simpler, richer  residuals by frame, in the order of time; of equal sizes
ForecastWeight WeighForecasts(const std::vector<Eigen::VectorXd>& simpler,
                              const std::vector<Eigen::VectorXd>& richer);

}  // namespace dpe

#endif  // DPE_ESTIMATION_FORECAST_WEIGHT_H_
