#!/usr/bin/env python3
"""Writes the seeds of the fuzzers: small files of each format that are accepted.

    tests/fuzz/make_corpus.py    writes into tests/fuzz/corpus/
"""

import json
import pathlib
import struct

CORPUS = pathlib.Path(__file__).resolve().parent / "corpus"
# A cloth of 3 x 3 vertices, as the fuzzers' scene has it, and two frames.
VERTICES = [(3.5 * (i - 1), 0.0, 3.5 * (j - 1)) for j in range(3) for i in range(3)]
FRAMES = [VERTICES, [(x, y - 0.1, z) for x, y, z in VERTICES]]
TRIANGLES = [(a, a + 1, a + 3) for a in (0, 1, 3, 4)] + [
    (a + 1, a + 4, a + 3) for a in (0, 1, 3, 4)]


def write(target, name, content):
    folder = CORPUS / target
    folder.mkdir(parents=True, exist_ok=True)
    data = content if isinstance(content, bytes) else content.encode()
    (folder / name).write_bytes(data)


def csv():
    rows = "".join(f"{f},{v},{x},{y},{z}\n" for f, frame in enumerate(FRAMES)
                   for v, (x, y, z) in enumerate(frame))
    write("csv", "vertices.csv", "frame,vertex,x,y,z\n" + rows)
    write("csv", "second_object.csv", "frame,vertex,x,y,z,sigma\n0,12,1,2,3,\n"
          "4,12,1e-3,-2.5,3,0.01\n4,17,nan,nan,nan,\n")
    write("csv", "markers.csv", "\ufefftime,marker,x,y,z,sigma\r\n0,hip,0,0,0,0.1\r\n"
          "0,knee,3.5,0,0.1,\r\n0.013,hip,0.1,+0.2,0,0.1\r\n")


def trc():
    def header(rate, units, tab="\t"):
        return (tab.join(["PathFileType", "4", "(X/Y/Z)", "a.trc"]) + "\n" +
                tab.join(["DataRate", "CameraRate", "NumFrames", "NumMarkers", "Units",
                          "OrigDataRate", "OrigDataStartFrame", "OrigNumFrames"]) +
                "\n" + tab.join([rate, rate, "2", "2", units, rate, "1", "2"]) + "\n")
    names = "Frame#\tTime\tA\t\t\tB 1\t\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\t\n\n"
    write("trc", "gap.trc", header("60", "mm") + names + "1\t0.000\t1\t2\t3\t\t\t\r\n"
          "2\t0.017\t4\t5\t6\t7\t8\t9\t\t\n")
    write("trc", "times.trc", header("50", "m") + names +
          "11\t0.2\t0\t0\t0\t3.5\t0\t0\n14\t0.27\t0.1\t0\t0\t3.5\t0\t0.1\n")
    write("trc", "spaces.trc", header("60", "cm", " ").replace(" 2 2 ", " 1 1 ", 1) +
          "Frame# Time A\n X1 Y1 Z1\n1 0 1 2 3\n")


def obj():
    vertices = "".join(f"v {x} {y} {z}\n" for x, y, z in VERTICES)
    textures = "".join(f"vt {x / 7 + .5} {z / 7 + .5}\n" for x, y, z in VERTICES)
    write("obj", "grid.obj", "# cloth\no grid\n" + vertices + textures +
          "".join("f " + " ".join(f"{v + 1}/{v + 1}" for v in t) + "\n"
                  for t in TRIANGLES))
    write("obj", "quad.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 9 9 9\nvn 0 1 0\n"
          "vt 0 0\nvt 1 0 0\ng a\ns 1\nf -5//1 -4//1 -3//1 -2//1\n")
    write("obj", "points.obj", vertices)
    write("obj", "seam.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 1\n"
          "f 1/1 2/2 3/1\nf 2/1 4/2 3/1\n")


def binary():
    floats = [c for frame in FRAMES for vertex in frame for c in vertex]
    header = struct.pack("<12siiffi", b"POINTCACHE2\0", 1, 9, 0.0, 1.0, 2)
    write("pc2", "grid.pc2", header + struct.pack(f"<{len(floats)}f", *floats))
    header = struct.pack("<12siiffi", b"POINTCACHE2\0", 1, 18, 2.0, 0.5, 1)
    write("pc2", "two_objects.pc2",
          header + struct.pack(f"<{len(floats)}f", *floats))
    for name, kind, order, version in (("float64", "<f8", False, 1),
                                       ("float32", "<f4", False, 2),
                                       ("big_endian", ">f8", True, 1)):
        text = (f"{{'descr': '{kind}', 'fortran_order': {order}, "
                f"'shape': (2, 9, 3), }}").ljust(117) + "\n"
        length = struct.pack("<H" if version == 1 else "<I", len(text))
        code = kind[0] + str(len(floats)) + {"4": "f", "8": "d"}[kind[2]]
        write("npy", name + ".npy", b"\x93NUMPY" + bytes([version, 0]) + length +
              text.encode() + struct.pack(code, *floats))


def json_files():
    point = "{{\"x\": {}, \"y\": {}, \"z\": {}}}".format
    scene = {
        "title": "small", "delta": 0.02, "integrationMethod": 2, "tolerance": 1e-5,
        "optimizationIterations": 10, "forwardSubSteps": 3, "printTimes": True,
        "windVel": "WIND", "objects": [{
            "vertPos": "POSITIONS", "vertIsFixed": [True, False, False],
            "vertMass": [0.5, 0.25, 0.125], "springs": [0, 1, 1, 2],
            "springStiffness": [10, 20], "triangles": [0, 1, 2],
            "dragCoefficient": 0.3, "damping": 0.2, "optimizationSettings": "nL"}],
        "colliders": [{"type": 1, "pos": "WIND"}]}

    def text(value):
        return (json.dumps(value).replace('"WIND"', point(1.5, 0, -2))
                .replace('"POSITIONS"', "[" + ", ".join(
                    (point(0, 0, 0), point(1, 0, 0), point(0, 0, 1))) + "]"))
    write("scene", "legacy.txt", "// a comment\n" + text(scene))
    scene["objects"][0].update({
        "vertVel": "POSITIONS", "springKind": ["stretch", "bend"],
        "springGroup": [0, 1], "vertexGroup": [0, 0, 1], "springRestLength": [1, 1.4],
        "prescribedPaths": [{"vertex": 0, "positions": "POSITIONS"}],
        "estimate": {"damping": True, "dragCoefficient": True,
                     "initialVelocity": True, "initialPosition": True}})
    scene["colliders"].append({"type": 0, "pos": "WIND", "rot": "WIND",
                               "scale": "WIND", "stiffness": 100})
    scene.update({"integrationMethod": "tr_bdf2", "gravity": "WIND",
                  "aerodynamics": "unit_normal", "solver": "cg",
                  "estimate": {"wind": True}})
    write("scene", "all_keys.txt", text(scene))

    write("checkpoint", "fit.json", json.dumps({
        "format": "dpe checkpoint", "version": 1,
        "problem": {"settings": "nG", "frames": "100"}, "stage": "grow",
        "init": "uniform", "notes": ["a note"], "num_frames": 20,
        "horizons": [{"num_frames": 10, "iterations": 3, "start_rms": 0.1,
                      "final_rms": None}],
        "iterations": 7, "first_iteration": 3, "radius": 1e4, "seconds": 0.5,
        "initial_cost": 1.5, "initial_rms": None, "cost": 1e-20,
        "start": [1.0, 2.0], "coordinates": [1.25, -2e-3]}, indent=1))
    write("marker_map", "map.csv", "marker,vertex\nhip,0\nknee, 17\n\n\"a b\",4\n")

    # Both objects' single stiffness, and the first one's masses by vertex.
    entries = [
        {"object": 0, "kind": "stiffness", "standard_deviations": [0.5]},
        {"object": 1, "kind": "stiffness", "standard_deviations": [None]},
        {"object": None, "kind": "wind", "standard_deviations": [1, 1, 1]}]
    write("report", "report.json", json.dumps({
        "settings": "nG,nG",
        "uncertainty": {"ok": True, "message": "", "parameters": entries}}))
    write("report", "none.json", json.dumps({
        "settings": "nG", "uncertainty": {"ok": False, "message": "not asked for"}}))


def call_order():
    # Bytes are drawn as calls and their arguments: any are a sequence.
    write("call_order", "count", bytes(range(256)))
    write("call_order", "mixed", bytes((37 * i * i + 11 * i + 3) % 256
                                       for i in range(1000)))


if __name__ == "__main__":
    for make in (csv, trc, obj, binary, json_files, call_order):
        make()
