"""Makes a small character in Blender, with a skin, bones and two actions, and exports it: blender --background --python walker.py -- OUT.glb [PICTURE.png]"""
import builtins
import math
import sys

import bpy
import numpy

# Blender 3.4's exporter says numpy's old names.
for name in ("bool", "int", "float", "object"):
    if name not in numpy.__dict__:
        setattr(numpy, name, getattr(builtins, name))

arguments = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.read_factory_settings(use_empty=True)

# A body of spheres, joined and melted together. z is up, and it faces -y, as Blender's characters do. Lengths are metres.
balls = [
    ((0, 0, 0.95), 0.17), ((0, 0, 1.2), 0.2), ((0, 0, 1.42), 0.12), ((0, -0.02, 1.66), 0.16),
    *[((side * x, 0, z), r) for side in (-1, 1) for x, z, r in [
        *[(0.13, 0.08 + 0.07 * i, 0.055 + 0.004 * i) for i in range(11)],
        *[(0.2 + 0.06 * i, 1.33, 0.085 - 0.003 * i) for i in range(9)]]],
    ((0.13, -0.07, 0.05), 0.055), ((-0.13, -0.07, 0.05), 0.055),
]
parts = []
for place, radius in balls:
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=12, radius=radius, location=place)
    parts.append(bpy.context.object)
for part in parts:
    part.select_set(True)
bpy.ops.object.join()
body = bpy.context.object
body.name = "Body"
remesh = body.modifiers.new("Melt", "REMESH")
remesh.mode, remesh.voxel_size = "VOXEL", 0.025
smooth = body.modifiers.new("Smooth", "SMOOTH")
smooth.iterations = 8
bpy.ops.object.modifier_apply(modifier="Melt")
bpy.ops.object.modifier_apply(modifier="Smooth")
bpy.ops.object.shade_smooth()
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="SELECT")
bpy.ops.uv.smart_project()
bpy.ops.object.mode_set(mode="OBJECT")
clay = bpy.data.materials.new("Clay")
clay.use_nodes = True
shader = clay.node_tree.nodes["Principled BSDF"]
shader.inputs["Base Color"].default_value = (0.75, 0.22, 0.06, 1)
shader.inputs["Roughness"].default_value = 0.55
body.data.materials.clear()
body.data.materials.append(clay)

# Bones: hips, spine, head, and arms and legs of two each.
bpy.ops.object.armature_add(location=(0, 0, 0))
rig = bpy.context.object
bpy.ops.object.mode_set(mode="EDIT")
bones = rig.data.edit_bones
bones.remove(bones[0])


def bone(name, head, tail, parent=None):
    made = bones.new(name)
    made.head, made.tail = head, tail
    made.parent = bones[parent] if parent else None


bone("Hips", (0, 0, 0.9), (0, 0, 1.05))
bone("Spine", (0, 0, 1.05), (0, 0, 1.42), "Hips")
bone("Head", (0, 0, 1.42), (0, 0, 1.8), "Spine")
for side, letter in ((1, "L"), (-1, "R")):
    bone(f"Arm.{letter}", (side * 0.18, 0, 1.33), (side * 0.42, 0, 1.33), "Spine")
    bone(f"Hand.{letter}", (side * 0.42, 0, 1.33), (side * 0.7, 0, 1.33), f"Arm.{letter}")
    bone(f"Thigh.{letter}", (side * 0.13, 0, 0.85), (side * 0.13, 0, 0.46), "Hips")
    bone(f"Shin.{letter}", (side * 0.13, 0, 0.46), (side * 0.13, -0.02, 0.05), f"Thigh.{letter}")
bpy.ops.object.mode_set(mode="OBJECT")
body.select_set(True)
bpy.context.view_layer.objects.active = rig
bpy.ops.object.parent_set(type="ARMATURE_AUTO")

# Two actions of 30 frames a second.
bpy.context.scene.render.fps = 30
rig.animation_data_create()
for pose in rig.pose.bones:
    pose.rotation_mode = "XYZ"


def action(name, frames, turns):
    made = bpy.data.actions.new(name)
    made.use_fake_user = True
    rig.animation_data.action = made
    for frame in range(0, frames + 1, 3):
        phase = 2 * math.pi * frame / frames
        for bone_name, turn in turns.items():
            pose = rig.pose.bones[bone_name]
            pose.rotation_euler = turn(phase)
            pose.keyframe_insert("rotation_euler", frame=frame)
    track = rig.animation_data.nla_tracks.new()
    track.name = name
    track.strips.new(name, 0, made)
    rig.animation_data.action = None
    for pose in rig.pose.bones:
        pose.rotation_euler = (0, 0, 0)


swing = lambda size, shift=0.0: lambda phase: (size * math.sin(phase + shift), 0, 0)
knee = lambda shift: lambda phase: (0.4 - 0.4 * math.cos(phase + shift), 0, 0)
action("Walk cycle", 30, {
    "Thigh.L": swing(0.5), "Thigh.R": swing(-0.5), "Shin.L": knee(0.6), "Shin.R": knee(0.6 + math.pi),
    "Arm.L": lambda phase: (-1.2, 0, -0.5 * math.sin(phase)), "Arm.R": lambda phase: (-1.2, 0, -0.5 * math.sin(phase)),
    "Spine": lambda phase: (0, 0.08 * math.sin(phase), 0),
})
action("Wave", 60, {
    "Arm.L": lambda phase: (0.4, 0, 0), "Hand.L": lambda phase: (0.8 + 0.5 * math.sin(2 * phase), 0, 0),
    "Arm.R": lambda phase: (-1.2, 0, 0), "Head": lambda phase: (0, 0.15 * math.sin(phase), 0),
})

bpy.ops.export_scene.gltf(filepath=arguments[0], export_format="GLB", export_animations=True, export_nla_strips=True)

if len(arguments) > 1:
    scene = bpy.context.scene
    bpy.ops.object.camera_add(location=(1.9, -3.6, 1.7), rotation=(math.radians(80), 0, math.radians(28)))
    scene.camera = bpy.context.object
    bpy.ops.object.light_add(type="SUN", rotation=(0.7, 0.3, 0.4))
    bpy.context.object.data.energy = 3
    scene.world = bpy.data.worlds.new("World")
    scene.world.color = (0.05, 0.06, 0.07)
    rig.animation_data.nla_tracks["Walk cycle"].is_solo = True
    for pose in rig.pose.bones:
        pose.rotation_euler = (0, 0, 0)
    scene.frame_set(8)
    rig.show_in_front = True
    scene.render.engine, scene.cycles.samples = "CYCLES", 48
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y = 640, 480
    scene.render.filepath = arguments[1]
    bpy.ops.render.render(write_still=True)
