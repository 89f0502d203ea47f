#include "long/differential_tracer.h"

#include "long/differential_light.h"
#include "long/differential_paths.h"
#include "long/differential_tally.h"
#include "long/differential_world.h"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>

namespace sunfleck::test::differential {
namespace {

constexpr std::uint64_t seeds_apart = 1'000'003;

bool is_of_sensor(Of of) {
  return of == Of::sensor_direct || of == Of::sensor_sky || of == Of::sensor_scattered;
}

double read_value(const std::vector<Paths::Reading>& readings, const Figure& figure) {
  const Paths::Reading& reading = readings[figure.place];
  if (figure.of == Of::sensor_direct) return reading.direct[figure.band];
  return (figure.of == Of::sensor_sky ? reading.sky : reading.scattered)[figure.band];
}

// Returns the mean of the batches and its standard error.
Stated mean_of(const std::vector<std::vector<double>>& values, std::size_t figure) {
  const auto n = static_cast<double>(values.size());
  double sum = 0.0;
  for (const std::vector<double>& batch : values) sum += batch[figure];
  const double mean = sum / n;
  double squares = 0.0;
  for (const std::vector<double>& batch : values) squares += (batch[figure] - mean) * (batch[figure] - mean);
  return {mean, std::sqrt(squares / (n - 1.0) / n)};
}

}  // namespace

std::vector<Stated> trace_figures(const RadiationModel& model, const std::vector<Figure>& figures, const TracerWork& work) {
  const World world(model);
  const Light light(model, world);
  const Survey survey(model, world, light);
  const Paths paths(model, world, light);
  std::vector<std::vector<double>> values(work.batches);
  oneapi::tbb::parallel_for(std::size_t{0}, work.batches, [&](std::size_t batch) {
    Dice dice(work.seed * seeds_apart + batch);
    Tally tally(model, survey);
    paths.follow_light(work.cells, dice, tally);
    std::vector<Paths::Reading> readings;
    for (const Sensor& sensor : model.sensors) readings.push_back(paths.read(sensor, work.sensor_paths, dice));
    for (const Figure& figure : figures) {
      values[batch].push_back(is_of_sensor(figure.of) ? read_value(readings, figure) : tally.value(figure));
    }
  });
  std::vector<Stated> stated;
  for (std::size_t k = 0; k < figures.size(); ++k) stated.push_back(mean_of(values, k));
  return stated;
}

}  // namespace sunfleck::test::differential
