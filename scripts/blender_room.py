"""Builds a room with fog in Blender and exports it for Tyndall. docs/blender.md walks through it.

    blender --background --python-exit-code 1 --python scripts/blender_room.py -- ROOM.glb
"""

import math
import sys

import bpy


def material(name, color, roughness=0.8):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    surface = made.node_tree.nodes["Principled BSDF"]
    surface.inputs["Base Color"].default_value = (*color, 1)
    surface.inputs["Roughness"].default_value = roughness
    return made


def tiles(name):
    """A checked picture, repeated by a Mapping node: KHR_texture_transform in the file."""
    made = material(name, (1, 1, 1), 0.5)
    size = 64
    picture = bpy.data.images.new(name, size, size)
    pixels = []
    for y in range(size):
        for x in range(size):
            joint = x % 32 < 1 or y % 32 < 1
            shade = 0.08 if joint else 0.45 if (x // 32 + y // 32) % 2 else 0.3
            pixels += [shade, shade * 0.9, shade * 0.75, 1]
    picture.pixels = pixels
    picture.pack()
    nodes, links = made.node_tree.nodes, made.node_tree.links
    texture, mapping = nodes.new("ShaderNodeTexImage"), nodes.new("ShaderNodeMapping")
    coordinates = nodes.new("ShaderNodeUVMap")
    texture.image = picture
    coordinates.uv_map = "UVMap"
    mapping.inputs["Scale"].default_value = (6, 8, 1)
    links.new(coordinates.outputs["UV"], mapping.inputs["Vector"])
    links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
    links.new(texture.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    return made


def box(name, low, high, look):
    """From one corner to the other, in metres, z up."""
    center = [(a + b) / 2 for a, b in zip(low, high)]
    bpy.ops.mesh.primitive_cube_add(size=1, location=center)
    made = bpy.context.object
    made.name = name
    made.scale = [b - a for a, b in zip(low, high)]
    if look is not None:
        made.data.materials.append(look)
    return made


def light(name, kind, place, turned=(0, 0, 0)):
    made = bpy.data.objects.new(name, bpy.data.lights.new(name, kind))
    made.location = place
    made.rotation_euler = turned
    bpy.context.scene.collection.objects.link(made)
    return made


def build():
    scene = bpy.context.scene
    plaster, wood = material("plaster", (0.7, 0.66, 0.6)), material("wood", (0.25, 0.13, 0.06), 0.6)
    # 6 m wide, 8 m deep and 3.5 m high inside; walls of 0.3 m, the window in the one towards +x.
    box("floor", (-3.3, -4.3, -0.3), (3.3, 4.3, 0), tiles("tiles"))
    box("ceiling", (-3.3, -4.3, 3.5), (3.3, 4.3, 3.8), plaster)
    box("wall west", (-3.3, -4.3, 0), (-3, 4.3, 3.5), plaster)
    box("wall south", (-3, -4.3, 0), (3, -4, 3.5), plaster)
    box("wall north", (-3, 4, 0), (3, 4.3, 3.5), plaster)
    box("wall east, below", (3, -4.3, 0), (3.3, 4.3, 1), plaster)
    box("wall east, above", (3, -4.3, 2.9), (3.3, 4.3, 3.5), plaster)
    box("wall east, left", (3, 1.5, 1), (3.3, 4.3, 2.9), plaster)
    box("wall east, right", (3, -4.3, 1), (3.3, -1.5, 2.9), plaster)
    for y in (-0.75, 0, 0.75):
        box("mullion", (3.1, y - 0.04, 1), (3.2, y + 0.04, 2.9), wood)
    box("transom", (3.1, -1.5, 1.9), (3.2, 1.5, 1.98), wood)
    box("table top", (-1.9, 0.9, 0.72), (-0.5, 2.5, 0.78), wood)
    for x in (-1.8, -0.6):
        for y in (1, 2.4):
            box("table leg", (x - 0.04, y - 0.04, 0), (x + 0.04, y + 0.04, 0.72), wood)

    # A door that swings: one action, which the exporter writes as an animation.
    door = box("door", (-0.5, 3.9, 0), (0.5, 3.96, 2.1), wood)
    for frame, angle in ((1, 0), (49, -60), (97, 0)):
        door.rotation_euler[2] = math.radians(angle)
        door.keyframe_insert("rotation_euler", frame=frame)
    door.animation_data.action.name = "door"
    scene.frame_end = 97

    # Lighting Mode Standard makes 683 lx of 1 W/m²: 41,000 lx, and 54.4 cd of 1 W.
    sun = light("sun", "SUN", (6, 0, 6), (0, math.radians(58), math.radians(12)))
    sun.data.energy = 60
    sun.data.color = (1, 0.9, 0.75)
    lamp = light("lamp", "POINT", (-1.2, 1.7, 1.1))
    lamp.data.energy = 8
    lamp.data.color = (1, 0.6, 0.3)
    lamp.data["radius"] = 0.05  # m, of the bulb
    # Tyndall's exposure: a luminance of 1.2 * 2^9.5 cd/m² shows as 1. Without it the sun alone would choose it.
    scene["exposure"] = 9.5

    # Fog by placing: an empty says where the dust of the room is, a box where mist lies on the floor.
    dust = bpy.data.objects.new("dust", None)
    dust.empty_display_type = "CUBE"
    dust.location, dust.scale = (0, 0, 1.75), (3, 4, 1.75)
    dust["medium"] = {"scattering": [0.06, 0.06, 0.06], "anisotropy": 0.6}
    scene.collection.objects.link(dust)
    mist = box("mist", (-3, -4, 0), (3, 4, 0.8), None)
    mist["medium"] = (
        '{"scattering": [0.5, 0.5, 0.5], "anisotropy": 0.3, "height": {"base": 0, "falloff": 0.2},'
        ' "noise": {"scale": 0.8, "amount": 0.8, "seed": 3}}'
    )

    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = (-1.9, -3.7, 1.6)
    camera.rotation_euler = (math.radians(85), 0, math.radians(-25))
    camera.data.lens = 20
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = 1280, 720


def main():
    if "--" not in sys.argv or len(sys.argv) != sys.argv.index("--") + 2 or not sys.argv[-1].endswith(".glb"):
        sys.exit("usage: blender --background --python-exit-code 1 --python scripts/blender_room.py -- ROOM.glb")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    build()
    bpy.ops.export_scene.gltf(
        filepath=sys.argv[-1],
        export_cameras=True,  # Include: Cameras
        export_lights=True,  # Include: Punctual Lights
        export_extras=True,  # Include: Custom Properties, which hold fog and exposure
    )


main()
