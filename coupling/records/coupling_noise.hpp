#pragma once
// Does the coupling shake the force? What is exchanged once a window can show at the window's frequency f_w = 1/T and its
// harmonics alone, so the figure is how far the force's power spectral density stands out there.
#include <optional>
#include <vector>

namespace couloir {

struct NoiseHarmonic {
  double frequency = 0;        // [Hz] a multiple of f_w
  double over_neighbours = 1;  // power in the band about it over that beside it; 1: no peak
  double between = 1;          // the same half a window's frequency higher, where no exchange acts: how far chance goes
};

struct CouplingNoise {
  double window_frequency = 0;  // [Hz]
  double resolution = 0;        // [Hz] width of a bin
  int segments = 0;             // that the density is the mean of
  double over_neighbours = 1;   // of all harmonics together: sum of their bands' power over that of their neighbours'
  double between = 1;           // likewise
  double rms = 0;               // [N] of what stands out in the bands; 0 where nothing does
  std::vector<NoiseHarmonic> harmonics;
};

// force: [N] one-after-another means over `interval` [s], `per_window` of them a window, from the first contact on.
//
// Welch's estimate S(f) [N2/Hz]: segments of M windows, half overlapping, their means taken off, Hann's weights; M is the
// largest of 128, 64, 32, 16 of which four segments fit. With whole windows in a segment harmonic m falls on bin m M. Its band
// is that bin and the two beside it, which hold all of a steady tone under Hann's weights; its neighbours are the bins from 3
// to max(5, M/8 + 2) on both sides. Their density is the geometric mean of the two sides' means, which a spectrum that falls as
// a power of f does not bias. Harmonics whose neighbours do not reach past half the sampling frequency.
//
// Nothing where fewer than four segments of 16 windows fit, or no harmonic lies below half the sampling frequency.
//
// P. D. Welch (1967), The use of fast Fourier transform for the estimation of power spectra, IEEE Trans. Audio Electroacoust. 15.
std::optional<CouplingNoise> coupling_noise(const std::vector<double>& force, int per_window, double interval);

}  // namespace couloir
