"""Provides a separate display with a window manager, input as from a hand, and pictures of the display."""

import os
import struct
import subprocess
import time
import zlib

import numpy

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
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    with open(file, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                  chunk(b"IDAT", zlib.compress(rows, 3)) + chunk(b"IEND", b""))


def read_png(file):
    """Reads 8-bit red-green-blue without interlacing, the format that the program writes."""
    with open(file, "rb") as stream:
        data = stream.read()
    place, body = 8, b""
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", data[place + 8:place + 18])
            assert (depth, colour) == (8, 2)
        if kind == b"IDAT":
            body += data[place + 8:place + 8 + length]
        place += 12 + length
    raw = numpy.frombuffer(zlib.decompress(body), numpy.uint8).reshape(height, 1 + 3 * width)
    pixels = numpy.zeros((height, 3 * width), numpy.int32)
    above = numpy.zeros(3 * width, numpy.int32)
    for y in range(height):
        above = pixels[y] = unfiltered(raw[y, 0], raw[y, 1:].astype(numpy.int32), above)
    return pixels.reshape(height, width, 3).astype(numpy.uint8)


def unfiltered(kind, row, above):
    """Reverses the filter of one row by the PNG specification, section 9.2."""
    if kind == 0:
        return row
    if kind == 2:
        return (row + above) & 255
    out = numpy.zeros_like(row)
    for i, value in enumerate(row):
        a = out[i - 3] if i >= 3 else 0
        b = above[i]
        c = above[i - 3] if i >= 3 else 0
        if kind == 1:
            guess = a
        elif kind == 3:
            guess = (a + b) // 2
        else:
            p = a + b - c
            guess = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
        out[i] = (value + guess) & 255
    return out
