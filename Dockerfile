# Runs sunfleck in a container: docker build -t sunfleck . && docker run --rm -v "$PWD:/work" sunfleck run stand.toml
FROM debian:12 AS build
WORKDIR /sunfleck
COPY scripts scripts
RUN scripts/install_packages.sh run && apt-get install -y --no-install-recommends dpkg-dev file
COPY . .
RUN cmake --preset release && cmake --build --preset release && cpack -G DEB --config build/release/CPackConfig.cmake -B /package

FROM debian:12
COPY --from=build /package/*.deb /tmp/
# Also installs what the package recommends: software Vulkan and gnuplot.
RUN apt-get update && apt-get install -y /tmp/*.deb && rm -rf /tmp/*.deb /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["sunfleck"]
