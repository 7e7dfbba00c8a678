"""ParaView: the discs of an export as filled circles of their own radius, coloured by fragment.

Graphical: File > Load State..., choose this file, once R.pvd is named in the next lines.
Without a window: xvfb-run -a pvbatch paraview-discs.py R.pvd picture.png
"""
import sys

from paraview.simple import (ColorBy, ExtractBlock, GetActiveViewOrCreate, GetAnimationScene, OpenDataFile, Render,
                             SaveScreenshot, Show)

PVD = sys.argv[1] if len(sys.argv) > 1 else "R.pvd"

run = OpenDataFile(PVD)
run.UpdatePipeline()
discs = ExtractBlock(Input=run, Selectors=["/Root/discs"])
discs.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
view.CameraParallelProjection = 1

shown = Show(discs, view)
shown.SetRepresentationType("Point Gaussian")
shown.ShaderPreset = "Plain circle"
shown.ScaleByArray = 1
shown.SetScaleArray = ["POINTS", "radius"]
shown.UseScaleFunction = 0
shown.GaussianRadius = 1.0
ColorBy(shown, ("POINTS", "fragment"))

GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
view.ResetCamera(True)
Render(view)
if len(sys.argv) > 2:
    SaveScreenshot(sys.argv[2], view, ImageResolution=[1200, 1200])
