"""The lines by which the boats of the scene harbour lie: each hangs from a boat's fitting to the pier's cleat or pile or to a buoy's ring."""
import json
import pathlib

import numpy as np

import fishing_boat
import pier
import rib
import rowing_boat
import surfaces as on
import yacht
from mesh import join
from model import Model
from shapes import Paint, ring, tube
from textures import Sheet

SCENE = pathlib.Path(__file__).resolve().parents[2] / "scenes" / "harbour.json"


class Place:
    """Where the scene has a thing: points of its own axes in the scene's."""

    def __init__(self, name):
        thing = next(t for t in json.loads(SCENE.read_text())["objects"] if t.get("name") == name)
        self.at, self.yaw = np.array(thing["at_m"], float), np.radians(thing.get("yaw_deg", 0))

    def __call__(self, x, y, z):
        c, s = np.cos(self.yaw), np.sin(self.yaw)
        return self.at + [x * c - z * s, y, x * s + z * c]


def catenary(a, b, slack, n):
    """A rope that hangs from a to b, so much longer than the way between them (y = k cosh(x / k); Bernoulli 1691)."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    across = np.hypot(*(b - a)[[0, 2]])
    rise = b[1] - a[1]
    length = np.hypot(across, rise) * slack
    wanted, low, high = np.sqrt(length ** 2 - rise ** 2), 0.05 * across, 1e4 * across
    for _ in range(100):
        k = np.sqrt(low * high)
        low, high = (k, high) if 2 * k * np.sinh(across / (2 * k)) > wanted else (low, k)
    lowest = across / 2 - k * np.arctanh(rise / length)
    t = np.linspace(0, 1, n)
    y = k * (np.cosh((across * t - lowest) / k) - np.cosh(lowest / k))
    path = a + np.outer(t, b - a)
    path[:, 1] = a[1] + y
    return path


def line(d, paint, r, ends, slack, loops):
    """Through rails to the last but one of `ends`, hanging from there to the last; loops: (place, radius) of its turns."""
    free = catenary(ends[-2], ends[-1], slack, d.n(18, 6))
    path = np.concatenate([np.array(ends[:-2]).reshape(-1, 3), free])
    parts = [tube(path, r, paint, 5 if d.full else 3)]
    for at, radius in loops if d.full else ():
        for k in range(2):
            parts.append(ring(np.asarray(at) + [0, 2.0 * r * k, 0], (0, 1, 0), radius, r, paint, 12, 5))
    return join(parts)


def lines():
    """(colour, radius, ends, slack, loops) of each."""
    hemp, blue, black = (0.84, 0.76, 0.60), (0.30, 0.42, 0.62), (0.16, 0.16, 0.18)
    deck = pier.DECK
    west, east = np.array([-12.0, 0.0, -24.4]), np.array([22.0, 0.0, -24.4])
    cleat = lambda at, z: at + [1.0, deck + 0.06, z]
    pile = lambda at, z: at + [-1.32, deck + 0.03, z]
    made = []

    trawler, place = fishing_boat.Boat(), Place("fishing boat")
    rail = lambda boat, z, up: boat.loft.points(boat.loft.t_at(z, 1.0), [1.0])[0, 0] + [0, up, 0]
    bow, stern = [0.0, trawler.deck_y(-4.9) + 0.30, -4.85], [1.2, trawler.deck_y(4.9, 1.2) + 0.20, 4.9]
    for fitting, z, end in ((bow, -5.0, -5.4), (stern, 5.0, 5.4), (stern, 4.4, -2.7)):
        over = rail(trawler, z, 0.05)
        made.append((hemp, 0.016, [place(*fitting), place(*over), pile(west, end)], 1.035, [(place(*fitting), 0.065), (pile(west, end), 0.185)]))
    place = Place("fishing boat at the buoy")
    ring_at = ring_of_buoy("fishing boat at the buoy")
    over = trawler.loft.points([0.0], [1.0])[0, 0] * [0, 1, 1] + [0, 0.10, -0.16]
    made.append((hemp, 0.018, [place(*bow), place(*over), ring_at], 1.02, [(place(*bow), 0.068)]))

    sloop, place = yacht.Boat(), Place("yacht at the pier")
    for z, end in ((-4.2, 3.4), (0.45, 3.4), (0.45, -4.6), (4.5, -4.6)):
        fitting = np.array([sloop.side_x(z) - 0.10, sloop.side_y(z) + 0.03, z])
        over = np.array([sloop.side_x(z) + 0.01, sloop.side_y(z) + 0.06, z])
        made.append((black, 0.010, [place(*fitting), place(*over), cleat(west, end)], 1.03, [(place(*fitting), 0.045), (cleat(west, end), 0.075)]))

    inflatable = rib.Boat()
    eye, leg = [0.0, inflatable.shift + 0.72, -3.05], [0.90, inflatable.floor + 0.55, 2.93]
    place = Place("rib")
    made.append((blue, 0.010, [place(*eye), cleat(east, 3.4)], 1.05, [(cleat(east, 3.4), 0.075)]))
    made.append((blue, 0.010, [place(*leg), cleat(east, -4.6)], 1.04, [(place(*leg), 0.045), (cleat(east, -4.6), 0.075)]))
    made.append((blue, 0.010, [Place("rib at the buoy")(*eye), ring_of_buoy("rib at the buoy")], 1.04, []))

    stem = rowing_boat.Boat().loft.points([0], [0.78])[0, 0]
    eye = [0.0, stem[1] - 0.03, stem[2] - 0.075]
    made.append((hemp, 0.008, [Place("tender")(*eye), pile(east, 0.0)], 1.06, [(pile(east, 0.0), 0.18)]))
    made.append((hemp, 0.008, [Place("rowing boat at the buoy")(*eye), ring_of_buoy("rowing boat at the buoy")], 1.05, []))
    return made


def ring_of_buoy(boat):
    """The ring of the buoy that lies nearest to a boat's bow."""
    bow = Place(boat)(0, 0, -3.0)
    buoys = [np.array(t["at_m"], float) for t in json.loads(SCENE.read_text())["objects"] if t["model"] == "buoy_mooring"]
    return min(buoys, key=lambda at: np.linalg.norm(at - bow)) + [0, 0.80, 0]


def build():
    sheet = Sheet("sheet", 512, 512, [("rope", 48, on.rope), ("spare", 16, on.rope)], 51)
    model = Model("harbour_lines", "fixed", [sheet], (25, 80, 400), 0)
    all_lines = lines()
    model.part("lines", lambda d: join([line(d, Paint(sheet["rope"], colour, whole=True), r, ends, slack, loops)
                                        for colour, r, ends, slack, loops in all_lines]))
    model.extras.update({"length_m": None, "beam_m": None, "seats": [], "grips": [], "lights": []})
    return model
