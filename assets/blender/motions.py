"""Makes of the walker what Mixamo gives: a character with its skin, and motions without: blender --background --python motions.py -- FOLDER"""
import math
import os
import runpy
import sys

import bpy

folder = sys.argv[sys.argv.index("--") + 1]
os.makedirs(folder, exist_ok=True)
sys.argv[sys.argv.index("--") + 1:] = [os.path.join(folder, "walker.glb")]
runpy.run_path(os.path.join(os.path.dirname(os.path.abspath(__file__)), "walker.py"))
os.remove(os.path.join(folder, "walker.glb"))

rig = next(thing for thing in bpy.data.objects if thing.type == "ARMATURE")
body = next(thing for thing in bpy.data.objects if thing.type == "MESH")
# A small file does for an example.
bpy.context.view_layer.objects.active = body
body.modifiers.new("Fewer", "DECIMATE").ratio = 0.15
bpy.ops.object.modifier_move_to_index(modifier="Fewer", index=0)
bpy.ops.object.modifier_apply(modifier="Fewer")
for bone in rig.data.bones:
    bone.name = f"mixamorig:{bone.name}"
while rig.animation_data.nla_tracks:
    rig.animation_data.nla_tracks.remove(rig.animation_data.nla_tracks[0])


def export(name, things, bakes):
    bpy.ops.object.select_all(action="DESELECT")
    for thing in things:
        thing.select_set(True)
    bpy.ops.export_scene.fbx(
        filepath=os.path.join(folder, name), use_selection=True, add_leaf_bones=False, bake_anim=bakes, bake_anim_use_nla_strips=False,
        bake_anim_use_all_actions=False, bake_anim_simplify_factor=0, object_types={"ARMATURE", "MESH"})


def take(action):
    for pose in rig.pose.bones:
        pose.location, pose.rotation_euler = (0, 0, 0), (0, 0, 0)
    rig.animation_data.action = action
    first, last = (int(frame) for frame in action.frame_range)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = first, last
    return first, last


# The character has a clip of its own: it breathes.
idle = bpy.data.actions.new("Idle")
take(idle)
spine = rig.pose.bones["mixamorig:Spine"]
for frame, bend in ((1, 0), (31, 0.06), (61, 0)):
    spine.rotation_euler = (bend, 0, 0)
    spine.keyframe_insert("rotation_euler", frame=frame)
take(idle)
export("walker.fbx", [rig, body], True)
hips = rig.pose.bones["mixamorig:Hips"]
for name, file in (("Walk cycle", "walking.fbx"), ("Wave", "waving.fbx")):
    action = bpy.data.actions[name]
    first, last = take(action)
    if name == "Walk cycle":
        # Two steps lead on by 1.2 m, as motions do that are not made in place. The bone's own y is up, and its z to the front.
        for frame in range(first, last + 1, 3):
            part = (frame - first) / (last - first)
            hips.location = (0, 0.03 * math.cos(4 * math.pi * part), 1.2 * part)
            hips.keyframe_insert("location", frame=frame)
    action.name = "mixamo.com"
    export(file, [rig], True)
    action.name = name
