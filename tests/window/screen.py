"""Provides a separate display with a window manager, input as from a hand, and pictures of the display."""

import os
import struct
import subprocess
import time

import numpy
from PIL import Image

WIDTH, HEIGHT = 1100, 900
# The font "fixed" is on every X server.
TWM_SETTINGS = """NoTitle
RandomPlacement
BorderWidth 0
NoGrabServer
TitleFont "fixed"
MenuFont "fixed"
IconFont "fixed"
ResizeFont "fixed"
IconManagerFont "fixed"
"""


class Screen:
    """An X server without hardware (Xvfb) whose frame buffer is a file, and twm, so that windows have focus and minimise."""

    def __init__(self, folder):
        self.folder = folder
        read_end, write_end = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write_end), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-fbdir", folder,
             "-nolisten", "tcp"], pass_fds=[write_end], stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(read_end) as pipe:
            self.display = ":" + pipe.readline().strip()
        self.environment = {**os.environ, "DISPLAY": self.display}
        self.environment.pop("WAYLAND_DISPLAY", None)
        settings = os.path.join(folder, "twmrc")
        with open(settings, "w", encoding="utf-8") as file:
            file.write(TWM_SETTINGS)
        self.manager = subprocess.Popen(["twm", "-f", settings], env={**self.environment, "LC_ALL": "C"},
                                        stderr=subprocess.DEVNULL)

    def close(self):
        for process in (self.manager, self.server):
            process.terminate()
            process.wait()

    def do(self, *words):
        """Runs one xdotool command, such as do("key", "h"); returns what it prints."""
        return subprocess.run(["xdotool", *map(str, words)], env=self.environment, check=True, capture_output=True,
                              text=True, timeout=600).stdout.strip()

    def drag(self, start, end, button=1, steps=8):
        self.do("mousemove", *map(int, start))
        self.do("mousedown", button)
        time.sleep(0.4)  # lets a frame see the button go down; the sleep below lets it see the end before the button goes up
        for k in range(1, steps + 1):
            self.do("mousemove", *(int(a + (b - a) * k / steps) for a, b in zip(start, end)))
            time.sleep(0.03)
        time.sleep(0.4)
        self.do("mouseup", button)

    def still_shot(self):
        """Returns a shot as soon as two in a row are alike."""
        last = self.shot()
        for _ in range(100):
            time.sleep(0.25)
            now = self.shot()
            if numpy.array_equal(last, now):
                break
            last = now
        return now

    def shot(self):
        """Returns the screen as an array of rows, columns, red-green-blue."""
        with open(os.path.join(self.folder, "Xvfb_screen0"), "rb") as file:
            data = file.read()
        # XWDFile.h: the size of the header is the first number, the size of the colour map the 20th
        head = struct.unpack(">25I", data[:100])
        start = head[0] + 12 * head[19]
        rows = numpy.frombuffer(data, numpy.uint8, head[12] * head[5], start).reshape(head[5], head[12] // 4, 4)
        return rows[:, :head[4], 2::-1].copy()


def write_png(file, pixels):
    Image.fromarray(pixels).save(file, compress_level=1)


def read_png(file):
    """Reads 8-bit red-green-blue, the format that the program writes."""
    with Image.open(file) as image:
        assert image.mode == "RGB"
        return numpy.array(image)
