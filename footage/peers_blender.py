# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# Blender's Defocus node on a picture and a map of radii in pixels, run by peers.sh:
# blender --background --python peers_blender.py -- PICTURE RADIUS LARGEST_RADIUS PREVIEW OUTPUT

import sys

import bpy

picture, radius, largest, preview, output = sys.argv[sys.argv.index("--") + 1:]
scene = bpy.context.scene
scene.use_nodes = True
tree = scene.node_tree
tree.nodes.clear()


def image_node(path, space):
    node = tree.nodes.new("CompositorNodeImage")
    node.image = bpy.data.images.load(path)
    node.image.colorspace_settings.name = space
    return node


source = image_node(picture, "Linear")
blur = image_node(radius, "Non-Color")
defocus = tree.nodes.new("CompositorNodeDefocus")
defocus.bokeh = "CIRCLE"
defocus.use_zbuffer = False  # the second input is the radius, times z_scale
defocus.z_scale = 1
defocus.blur_max = float(largest) + 1
defocus.use_preview = preview == "1"
result = tree.nodes.new("CompositorNodeComposite")
tree.links.new(source.outputs["Image"], defocus.inputs["Image"])
tree.links.new(blur.outputs["Image"], defocus.inputs["Z"])
tree.links.new(defocus.outputs["Image"], result.inputs["Image"])

render = scene.render
render.resolution_x, render.resolution_y = source.image.size
render.resolution_percentage = 100
render.image_settings.file_format = "OPEN_EXR"
render.image_settings.color_depth = "16"
render.image_settings.exr_codec = "ZIP"
render.use_file_extension = False
render.filepath = output
bpy.ops.render.render(write_still=True)
