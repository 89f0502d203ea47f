"""Tests the window as a user drives it: python3 window_test.py PROGRAM OUT [unittest's arguments]

Starts `sunfleck view` on a separate display, with software Vulkan, moves a real mouse over it and looks at the screen. Screen
shots stay in OUT. Exits with status 77 where the display's programs are missing.
"""

import json
import os
import queue
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy

from screen import HEIGHT, WIDTH, Screen, read_png, write_png

PROGRAM, OUT = sys.argv[1:3]
PATIENCE_S = 600.0  # limit for waits that would never end
SIZE = (1000, 840)
PLOT_M = 0.7  # side of the plot
NEEDED = ("Xvfb", "xdotool", "twm")

SCENE = """title = "Two leaves"
[plot]
size = [0.7, 0.7]
[sun]
elevation = 60.0
azimuth = 120.0
[[band]]
name = "PAR"
direct = 350.0
[soil]
reflectance = 0.15
patch = 0.02
[optics.leaf]
reflectance = 0.12
transmittance = 0.06
[accuracy]
direct = 0.005
indirect = 0.01
[[geometry]]
file = "leaves.obj"
optics = "leaf"
up = "y"
"""
NOON = "time = 2002-08-08T12:00:00+08:00\nlatitude = 40.02\nlongitude = 116.28"
# The same leaf as a .can file of CARIBU, one polygon per line.
CAN = """p 1 100001001001 3  0.3 0.3 0.4  0.7 0.3 0.4  0.3 0.7 0.4
p 1 100001001001 3  0.7 0.3 0.4  0.7 0.7 0.4  0.3 0.7 0.4
"""
OPT = "n 1\ns d 0.15\ne d 0.1 d 0.12 0.06 d 0.12 0.06\n"
# A leaf of plant 1 in the plot's south-west, and a leaf of plant 2 above its north-eastern corner.
MESH = """o plant1_leaf4
v 0.35 0.4 0.35
v 0.35 0.4 0.65
v 0.65 0.4 0.65
v 0.65 0.4 0.35
f 1 2 3
f 1 3 4
o plant2_leaf7
v 0.05 0.6 0.05
v 0.05 0.6 0.25
v 0.25 0.6 0.25
v 0.25 0.6 0.05
f 5 6 7
f 5 7 8
"""


class Window:
    """The program, and the events that it reports."""

    def __init__(self, screen, folder, *arguments, scene="leaves.toml"):
        self.screen = screen
        self.validation = os.path.join(folder, "validation.txt")
        settings = os.path.join(folder, "vk_layer_settings.txt")
        with open(settings, "w", encoding="utf-8") as file:
            file.write("khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG\n"
                       f"khronos_validation.log_filename = {self.validation}\n"
                       "khronos_validation.report_flags = error,warn\n")
        environment = {**screen.environment, "VK_INSTANCE_LAYERS": "VK_LAYER_KHRONOS_validation",
                       "VK_LAYER_SETTINGS_PATH": settings}
        self.errors = open(os.path.join(folder, "stderr.txt"), "w+", encoding="utf-8")
        self.process = subprocess.Popen(
            [PROGRAM, "view", scene, "--json", "--device", "lavapipe", "--size", f"{SIZE[0]}x{SIZE[1]}", *arguments],
            cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=self.errors, text=True)
        self.controls = {}
        self.stage = [0, 0, *SIZE]
        self.events = []
        self.lines = queue.Queue()
        threading.Thread(target=self.listen, daemon=True).start()

    def listen(self):
        for line in self.process.stdout:
            try:
                self.lines.put(json.loads(line))
            except ValueError:
                self.lines.put({"event": "not JSON", "line": line})
        self.lines.put(None)

    def take(self, event):
        if event["event"] == "controls":
            self.controls = event["controls"]
            self.stage = event["picture"]
        self.events.append(event)

    def take_waiting(self):
        """Takes the next event, if one comes soon."""
        try:
            event = self.lines.get(timeout=0.2)
        except queue.Empty:
            return
        if event is not None:
            self.take(event)

    def wait_for(self, name, **fields):
        """Waits for the next event of that name with these values, and returns it."""
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            try:
                event = self.lines.get(timeout=1.0)
            except queue.Empty:
                continue
            if event is None:
                self.errors.seek(0)
                raise AssertionError(f"the program ended before {name}: {self.errors.read()}")
            self.take(event)
            if event["event"] == name and all(event.get(key) == value for key, value in fields.items()):
                return event
        raise AssertionError(f"no {name} {fields} within {PATIENCE_S:.0f} s; last: {self.events[-3:]}")

    def heard_or_awaited(self, name, **fields):
        """The last event told so far of that name with these values, or the next one."""
        for event in reversed(self.events):
            if event["event"] == name and all(event.get(key) == value for key, value in fields.items()):
                return event
        return self.wait_for(name, **fields)

    def last_restart(self, because):
        """The number of the last wish that a drag has led to."""
        self.wait_until_input_is_taken()
        return self.heard_or_awaited("restarted", because=because)["wish"]

    def saved_files(self):
        return [event["file"] for event in self.events if event["event"] == "saved"]

    def wait_until_input_is_taken(self):
        """Input is taken in its order. The second of two key presses, each answered by an event, comes after whatever the frame of
        the first one had to tell of the input before it."""
        for _ in range(2):
            self.key("p")
            self.wait_for("saved")

    def place(self, control, share=0.5):
        """Returns the middle of a control, or a place along it. Waits until it is drawn."""
        while control not in self.controls:
            self.wait_for("controls")
        left, top, right, bottom = self.controls[control]
        return left + share * (right - left), 0.5 * (top + bottom)

    def in_picture(self, x, y):
        left, top, width, height = self.stage
        return left + x * width, top + y * height

    def picture(self):
        """Returns the picture as the screen shows it, with the pointer moved away."""
        self.screen.do("mousemove", WIDTH - 1, HEIGHT - 1)
        left, top, width, height = map(int, self.stage)
        return self.screen.still_shot()[top:top + height, left:left + width]

    def focus(self):
        self.screen.do("mousemove", *map(int, self.in_picture(0.02, 0.98)))
        time.sleep(0.2)

    def key(self, name):
        self.focus()
        self.screen.do("key", name)

    def leave(self):
        """Closes the window; returns the last event and the exit status."""
        self.key("ctrl+q")
        event = self.wait_for("closed")
        status = self.process.wait(PATIENCE_S)
        return event, status

    def validation_messages(self):
        if not os.path.exists(self.validation):
            return ""
        with open(self.validation, encoding="utf-8") as file:
            return file.read()

    def stop(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.process.stdout.close()
        self.errors.close()


def changed_share(before, after):
    return numpy.mean(numpy.any(before != after, axis=2))


class WindowTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.write("leaves.toml", SCENE)
        self.write("leaves.obj", MESH)
        self.screen = Screen(self.folder)
        self.addCleanup(self.screen.close)

    def write(self, name, text):
        file = os.path.join(self.folder, name)
        with open(file + ".new", "w", encoding="utf-8") as out:
            out.write(text)
        os.replace(file + ".new", file)

    def open(self, *arguments, scene="leaves.toml"):
        window = Window(self.screen, self.folder, *arguments, scene=scene)
        self.addCleanup(window.stop)
        window.wait_for("loaded")
        window.wait_for("controls")
        self.assertIsNone(self.screen.manager.poll(), "the window manager has ended")
        window.name = self.screen.do("search", "--name", "sunfleck").split()[0]
        self.screen.do("windowmove", "--sync", window.name, 0, 0)
        window.wait_for("picture", wish=1)
        return window

    def keep_shot(self, name):
        write_png(os.path.join(OUT, name + ".png"), self.screen.shot())

    def wait_until_changed(self, before):
        """Waits until a third of the screen has changed."""
        end = time.monotonic() + PATIENCE_S
        while numpy.mean(numpy.any(before != self.screen.shot(), axis=2)) < 0.3:
            self.assertLess(time.monotonic(), end, "the screen stays as it is")
            time.sleep(0.2)

    def wait_until_picture(self, window, is_right):
        """Until the screen shows such a picture."""
        end = time.monotonic() + PATIENCE_S
        while not is_right(window.picture()):
            self.assertLess(time.monotonic(), end, "the picture stays as it is")

    def expect_clean_end(self, window):
        event, status = window.leave()
        self.assertEqual(status, 0)
        self.assertEqual(window.validation_messages(), "")
        print(f"{self.id()}: {event['frames']} frames, median {event['frame_ms']:.0f} ms, 99 % {event['frame_ms_99']:.0f} ms")

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, check=True, capture_output=True, text=True).stdout

    def test_moving_the_sun_changes_light_and_picture(self):
        window = self.open()
        before = window.picture()
        self.keep_shot("start")
        self.screen.drag(window.place("elevation", 0.55), window.place("elevation", 0.3))
        last = window.last_restart("sun")
        window.heard_or_awaited("first_picture", wish=last)
        window.heard_or_awaited("converged", wish=last)
        window.heard_or_awaited("picture", wish=last)
        self.wait_until_picture(window, lambda after: changed_share(before, after) > 0.01)
        self.keep_shot("sun_moved")
        # However the figures changed meanwhile, every control stayed in its place.
        places = {}
        for event in window.events:
            for name, place in event["controls"].items() if event["event"] == "controls" else ():
                self.assertEqual(places.setdefault(name, place), place, name)
        self.assertIn("save_result", places)
        self.expect_clean_end(window)

    def test_a_played_day_moves_on_and_a_pause_refines_it(self):
        self.write("leaves.toml", SCENE.replace("elevation = 60.0\nazimuth = 120.0", NOON))
        window = self.open()
        window.key("space")
        wishes = [window.wait_for("restarted", because="sun")["wish"] for _ in range(8)]  # more moments than are simulated together
        window.heard_or_awaited("first_picture", wish=wishes[-2])
        self.keep_shot("played")
        window.key("space")
        paused = window.wait_for("restarted", because="pause")["wish"]
        converged = window.wait_for("converged", wish=paused)
        self.assertLessEqual(converged["direct_relative_error"], 0.005)
        self.assertLessEqual(converged["indirect_relative_error"], 0.01)
        window.wait_until_input_is_taken()
        self.assertEqual(max(event["wish"] for event in window.events if event["event"] == "restarted"), paused)
        self.expect_clean_end(window)

    def test_orbiting_does_not_begin_the_simulation_anew(self):
        window = self.open()
        before = window.picture()
        self.screen.drag(window.in_picture(0.4, 0.6), window.in_picture(0.6, 0.5))
        self.wait_until_picture(window, lambda after: changed_share(before, after) > 0.02)
        orbited = window.picture()
        self.screen.do("mousemove", *map(int, window.in_picture(0.5, 0.5)))
        self.screen.do("click", 4)  # the wheel
        self.wait_until_picture(window, lambda after: changed_share(orbited, after) > 0.01)
        self.keep_shot("orbited")
        window.wait_until_input_is_taken()
        self.assertNotIn("restarted", [event["event"] for event in window.events])
        window.key("1")
        self.wait_until_picture(window, lambda after: numpy.array_equal(after, before))  # the scene's own camera
        self.expect_clean_end(window)

    def test_picking_names_the_organ(self):
        window = self.open("--view", "top")
        seen = self.whole_plot(window)
        for organ, plant, rank, corner in (("leaf", 1, 4, (0.5, 0.5)), ("leaf", 2, 7, (0.15, 0.15))):
            self.click(self.plot_to_screen(window, seen, corner))
            event = window.wait_for("picked")
            self.assertEqual((event["what"], event["organ"], event["plant"], event["rank"]), ("organ", organ, plant, rank))
            whole = 0.09 if plant == 1 else 0.04
            self.assertAlmostEqual(event["area_m2"], whole, places=6)
            self.assertEqual(event["triangles"], 2)
            self.assertAlmostEqual(event["direct"]["value"] / 350.0, 1.0, delta=0.02)
            for figure in ("direct", "indirect", "absorbed"):
                self.assertGreater(event[figure]["error"], 0.0)
            around_organ = self.outline(window)
            self.keep_shot(f"picked_organ_{plant}")
            self.click(self.plot_to_screen(window, seen, corner))
            event = window.wait_for("picked")
            self.assertEqual((event["what"], event["organ"], event["plant"], event["rank"]), ("triangle", organ, plant, rank))
            around_triangle = self.outline(window)
            self.assertGreater(around_organ.sum(), 100)
            self.assertGreater((around_triangle & ~around_organ).sum(), 30)  # the diagonal
            self.assertGreater((around_organ & ~around_triangle).sum(), 30)
            # Half of the square, lit only by the beam and the light from the soil.
            self.assertAlmostEqual(event["triangle_area_m2"], 0.5 * whole, places=6)
            self.assertAlmostEqual(event["upper"]["direct"] / 350.0, 1.0, delta=0.02)
            self.assertEqual(event["lower"]["direct"], 0.0)
            self.assertGreater(event["lower"]["scattered"], 0.0)
            self.assertGreater(event["upper"]["error"], 0.0)
            self.assertLess(event["upper"]["error"], 0.05 * event["upper"]["irradiance"])
        self.keep_shot("picked")
        self.expect_clean_end(window)

    def outline(self, window):
        """Returns which pixels of the picture have the colour of the line around what is picked."""
        return numpy.all(window.picture() == (255, 0, 200), axis=2)

    def test_a_compass_shows_north_and_the_sun(self):
        window = self.open("--view", "top")
        left, top, right, bottom = window.controls["compass"]
        middle, radius = (0.5 * (left + right), 0.5 * (top + bottom)), 0.5 * (right - left)
        shown = self.screen.still_shot().astype(int)
        self.keep_shot("compass")
        def colour_at(azimuth_deg, reach):
            angle = numpy.radians(azimuth_deg)  # north is up and east right
            x, y = middle[0] + reach * radius * numpy.sin(angle), middle[1] - reach * radius * numpy.cos(angle)
            return shown[round(y), round(x)]
        sun = (250, 190, 0)
        self.assertLess(abs(colour_at(120.0, 1.0 / 3.0) - sun).max(), 10)  # 60 degrees above the horizon
        self.assertGreater(abs(colour_at(300.0, 1.0 / 3.0) - sun).max(), 50)
        self.assertLess(abs(colour_at(0.0, 0.9) - (190, 25, 13)).max(), 40)
        self.expect_clean_end(window)

    def test_a_chosen_sky_sheds_light(self):
        window = self.open("--view", "top")
        seen = self.whole_plot(window)
        self.click(window.place("sky"))
        window.place("sky/uniform")
        window.wait_for("controls")  # the list gets its place in its second frame
        self.click(window.place("sky/uniform"))
        # The scene says nothing about diffuse light: a fifth of 350 W m-2 is assumed.
        self.assertEqual(window.heard_or_awaited("assumed_diffuse")["share"], 0.2)
        last = window.last_restart("sky")
        window.heard_or_awaited("converged", wish=last)
        window.heard_or_awaited("picture", wish=last)
        self.keep_shot("sky_chosen")
        for _ in range(2):
            self.click(self.plot_to_screen(window, seen, (0.15, 0.15)))
            event = window.wait_for("picked")
        self.assertAlmostEqual(event["upper"]["sky"] / 70.0, 1.0, delta=0.05)  # nothing is above this leaf
        self.assertAlmostEqual(event["upper"]["direct"] / 280.0, 1.0, delta=0.02)
        self.expect_clean_end(window)

    def test_every_chart_can_be_chosen(self):
        window = self.open("--chart", "map")
        charts = ("rank", "rank-interval", "rank-log", "hue", "map")
        for chart in ("hue", "rank-log", "map"):
            self.click_until(window, "chart", lambda: f"chart/{chart}" in window.controls)
            for listed in charts:
                window.place(f"chart/{listed}")
            time.sleep(0.5)  # the list gets its place in its second frame
            window.take_waiting()
            self.click_until(window, f"chart/{chart}", lambda: f"chart/{chart}" not in window.controls)
            before = len(window.saved_files())
            self.click_until(window, "save_picture", lambda: len(window.saved_files()) > before)
            self.assertIn(f"view_{chart}_", window.saved_files()[-1])
        self.expect_clean_end(window)

    def test_pictures_have_the_chosen_size(self):
        window = self.open()
        window.heard_or_awaited("converged", wish=1)
        window.heard_or_awaited("picture", wish=1)

        def last_saved():
            return read_png(os.path.join(self.folder, window.saved_files()[-1]))

        def has_own_size():
            window.wait_until_input_is_taken()  # which ends with a saved picture
            return last_saved().shape == (1200, 1600, 3)

        self.click_until(window, "own_size", has_own_size, share=0.1)
        before = len(window.saved_files())
        self.click_until(window, "save_picture", lambda: len(window.saved_files()) > before)
        saved = last_saved()
        self.assertEqual(saved.shape, (1200, 1600, 3))
        self.run_program("render", "leaves.toml", "--device", "lavapipe", "-o", "rendered.png", "--quiet")
        rendered = read_png(os.path.join(self.folder, "rendered.png"))
        far = numpy.any(numpy.abs(saved.astype(int) - rendered.astype(int)) > 1, axis=2)
        self.assertLessEqual(far.mean(), 0.001)
        self.keep_shot("own_size")
        self.expect_clean_end(window)

    def click(self, place):
        self.screen.do("mousemove", *map(int, place))
        time.sleep(0.2)  # lets a frame see the pointer before the button
        self.screen.do("click", 1)
        time.sleep(0.2)  # and another one see the button up again before the pointer leaves

    def click_until(self, window, control, is_taken, share=0.5):
        """Clicks until that has an effect: on a busy machine frames may take so long that a click is lost."""
        for _ in range(8):
            self.click(window.place(control, share))
            end = time.monotonic() + 20.0
            while time.monotonic() < end:
                if is_taken():
                    return
                window.take_waiting()
        self.fail(f"clicks on {control} have no effect")

    def whole_plot(self, window):
        """Returns a picture from above with all borders of the plot, which the view at the start may cut off."""
        def borders_are_seen(picture):
            black = numpy.all(picture < 40, axis=2)
            return min(black.mean(axis=0).max(), black.mean(axis=1).max()) > 0.3
        window.key("f")
        self.wait_until_picture(window, borders_are_seen)
        return window.picture().astype(int)

    def plot_to_screen(self, window, seen, place):
        """Finds a place of the square plot (X, Z in metres) in a picture from above: north is up and east right, the plot's western
        and southern borders are black, its eastern border is the red axis."""
        black = numpy.all(seen < 40, axis=2)
        red = (seen[:, :, 0] > 150) & (seen[:, :, 1] < 80) & (seen[:, :, 2] < 80)
        west, east, south = black.mean(axis=0).argmax(), red.mean(axis=0).argmax(), black.mean(axis=1).argmax()
        x, z = place
        px_per_m = (east - west) / PLOT_M
        return window.stage[0] + east - z * px_per_m, window.stage[1] + south - (PLOT_M - x) * px_per_m

    def test_survives_other_sizes_and_being_minimised(self):
        window = self.open()
        for width, height in ((640, 480), (1050, 800)):
            self.screen.do("windowsize", window.name, width, height)
            event = window.wait_for("picture", height=height)
            self.assertEqual(event["width"], width - int(window.stage[0]))
            self.keep_shot(f"size_{width}")
        shown = self.screen.still_shot()
        self.screen.do("windowminimize", window.name)
        self.wait_until_changed(shown)
        hidden = self.screen.still_shot()
        self.screen.do("windowmap", window.name)
        self.wait_until_changed(hidden)
        self.screen.drag(window.place("azimuth", 0.3), window.place("azimuth", 0.5))
        window.wait_for("converged")
        self.expect_clean_end(window)

    def test_converges_to_what_render_draws_and_run_computes(self):
        window = self.open("--chart", "hue")
        converged = [event for event in window.events if event["event"] == "converged"][0]
        window.key("h")
        window.wait_for("picture", width=SIZE[0], height=SIZE[1])
        shown = window.picture()
        self.keep_shot("without_panel")
        self.run_program("render", "leaves.toml", "--device", "lavapipe", "--chart", "hue", "--size",
                         f"{SIZE[0]}x{SIZE[1]}", "-o", "rendered.png", "--quiet")
        rendered = read_png(os.path.join(self.folder, "rendered.png"))
        far = numpy.any(numpy.abs(shown.astype(int) - rendered.astype(int)) > 1, axis=2)
        self.assertLessEqual(far.mean(), 0.001)
        summary = json.loads(self.run_program("run", "leaves.toml", "--device", "lavapipe", "--images", "none", "--json"))
        band = summary["bands"][0]
        for key in ("absorbed_vegetation", "absorbed_soil", "reflected"):
            self.assertEqual(converged[key], band[key])
        self.assertEqual(converged["direct_relative_error"], summary["direct"]["relative_error"])
        self.expect_clean_end(window)

    def test_a_broken_scene_file_is_told_and_the_last_good_one_goes_on(self):
        window = self.open()
        self.write("leaves.toml", SCENE.replace("reflectance = 0.12", "reflectance = 1.2"))
        event = window.wait_for("problem")
        self.assertIn("reflectance", event["text"])
        time.sleep(0.5)
        self.keep_shot("broken_scene")
        self.screen.drag(window.place("azimuth", 0.3), window.place("azimuth", 0.5))
        window.wait_for("converged")
        self.write("leaves.toml", SCENE.replace("reflectance = 0.12", "reflectance = 0.2"))
        window.wait_for("loaded")
        window.wait_for("picture", wish=1)
        self.expect_clean_end(window)

    def test_a_changed_mesh_is_loaded_again(self):
        window = self.open()
        self.assertEqual([event["triangles"] for event in window.events if event["event"] == "loaded"], [4])
        before = window.picture()
        self.write("leaves.obj", MESH + "o plant3_leaf1\nv 0.1 0.7 0.7\nv 0.1 0.7 0.9\nv 0.4 0.7 0.9\nf 9 10 11\n")
        window.wait_for("loaded", triangles=5)
        window.wait_for("picture", wish=1)
        self.keep_shot("mesh_changed")
        self.assertGreater(numpy.mean(numpy.any(before != window.picture(), axis=2)), 0.005)
        # A broken mesh is reported; if the mesh is briefly missing, the window waits for it.
        self.write("leaves.obj", "f 1 2 3\n")
        self.assertIn("leaves.obj", window.wait_for("problem")["text"])
        os.remove(os.path.join(self.folder, "leaves.obj"))
        self.write("leaves.toml", SCENE + "# mended\n")
        self.assertIn("there is no such file", window.wait_for("problem")["text"])
        self.write("leaves.obj", MESH)
        window.wait_for("loaded", triangles=4)
        window.wait_for("picture", wish=1)
        self.expect_clean_end(window)

    def test_a_mesh_alone_is_shown(self):
        window = self.open("--error", "0.02", scene="leaves.obj")
        self.assertEqual([event["triangles"] for event in window.events if event["event"] == "loaded"], [4])
        self.write("leaves.obj", MESH + "o plant3_leaf1\nv 0.1 0.7 0.7\nv 0.1 0.7 0.9\nv 0.4 0.7 0.9\nf 9 10 11\n")
        window.wait_for("loaded", triangles=5)
        window.wait_for("picture", wish=1)
        self.expect_clean_end(window)

    def test_changed_files_of_caribu_are_loaded_again(self):
        self.write("stand.can", CAN)
        self.write("par.opt", OPT)
        self.write("sun.light", "350 -0.5 0.2 -1\n")
        self.write("plot.8", "0 0\n1 1\n")
        window = self.open("--optics", "par.opt", "--light", "sun.light", "--domain", "plot.8", "--error", "0.02",
                           scene="stand.can")
        bright = OPT.replace("d 0.12 0.06", "d 0.5 0.4")
        absorbed = [event for event in window.events if event["event"] == "converged"][0]["absorbed_vegetation"]
        for name, text in (("par.opt", bright), ("sun.light", "100 0 0 -1\n"), ("plot.8", "0 0\n2 2\n")):
            self.write(name, text)
            window.wait_for("loaded", triangles=2)
            now = window.wait_for("converged", wish=1)["absorbed_vegetation"]
            self.assertLess(now, 0.6 * absorbed, name)
            absorbed = now
            window.wait_for("picture", wish=1)
        self.expect_clean_end(window)

    def test_optics_keep_the_beams_and_results_are_saved(self):
        window = self.open()
        self.click_until(window, "section/Optics", lambda: "reflectance/leaf" in window.controls)
        self.screen.drag(window.place("reflectance/leaf", 0.1), window.place("reflectance/leaf", 0.4))
        converged = window.heard_or_awaited("converged", wish=window.last_restart("optics"))
        self.assertGreater(converged["spared_beams"], 0)
        self.keep_shot("optics")
        self.click_until(window, "save_result", lambda: any("folder" in event for event in window.events))
        with open(os.path.join(self.folder, "results", "leaves_view", "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
        self.assertTrue(summary["complete"])
        self.assertIn("changed", summary["scene_digest"])
        self.assertEqual(summary["bands"][0]["absorbed_vegetation"], converged["absorbed_vegetation"])
        view = os.path.join("results", "leaves_view")
        self.run_program("run", os.path.join(view, "scene.toml"), "--device", "lavapipe", "--images", "none", "--quiet", "-o",
                         "again")
        for name in ("organs.csv", "plants.csv", "profile.csv"):
            with open(os.path.join(self.folder, view, name), "rb") as one, \
                 open(os.path.join(self.folder, "again", name), "rb") as other:
                self.assertEqual(one.read(), other.read(), name)
        window.key("p")
        saved = window.wait_for("saved")
        above_message = slice(0, SIZE[1] - 80)
        stored = read_png(os.path.join(self.folder, saved["file"]))
        shown = window.picture()
        left, top, _, _ = window.controls["compass"]
        for picture in (stored, shown):
            picture[int(top) - 30:, int(left - window.stage[0]) - 30:] = 0  # the compass is in the window only
        self.assertTrue(numpy.array_equal(stored[above_message], shown[above_message]))
        self.expect_clean_end(window)

    def test_without_a_display_other_commands_are_named(self):
        environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
        done = subprocess.run([PROGRAM, "view", "leaves.toml"], cwd=self.folder, env=environment, capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 3)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertIn("sunfleck render", done.stderr)
        self.assertIn("sunfleck run", done.stderr)


if __name__ == "__main__":
    missing = [name for name in NEEDED if shutil.which(name) is None]
    if missing and os.environ.get("SUNFLECK_REQUIRE_DEVICE") != "1":
        print("skipped, missing:", *missing)
        sys.exit(77)
    os.makedirs(OUT, exist_ok=True)
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
