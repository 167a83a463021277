"""Draws cells of a .vtu in space, apart from each other, by VTK: foam.py FOAM.vtu PICTURE.png"""

import sys

import vtk
from vtk.util.numpy_support import vtk_to_numpy

APART = 1.22  # how far cells move from the middle

reader = vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
middle = [(low + high) / 2 for low, high in zip(*[iter(grid.GetBounds())] * 2)]
volumes = vtk_to_numpy(grid.GetCellData().GetArray("volume"))

points, polygons, colors = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkDoubleArray()
edges = vtk.vtkCellArray()
for c in range(grid.GetNumberOfCells()):
    cell = grid.GetCell(c)
    bounds = cell.GetBounds()
    center = [(low + high) / 2 for low, high in zip(*[iter(bounds)] * 2)]
    # A corner is cut away, so that the inside is seen.
    if center[0] > middle[0] and center[1] < middle[1] and center[2] > middle[2]:
        continue
    move = [(APART - 1) * (at - m) for at, m in zip(center, middle)]
    for f in range(cell.GetNumberOfFaces()):
        face = cell.GetFace(f)
        ids = [points.InsertNextPoint([x + d for x, d in zip(face.GetPoints().GetPoint(k), move)])
               for k in range(face.GetNumberOfPoints())]
        polygons.InsertNextCell(len(ids), ids)
        edges.InsertNextCell(len(ids) + 1, ids + ids[:1])
        colors.InsertNextValue(volumes[c])


def actor(data, **looks):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    shown = vtk.vtkActor()
    shown.SetMapper(mapper)
    return mapper, shown


faces = vtk.vtkPolyData()
faces.SetPoints(points)
faces.SetPolys(polygons)
faces.GetCellData().SetScalars(colors)
mapper, solid = actor(faces)
table = vtk.vtkColorTransferFunction()
ramp = [(0.95, 0.93, 0.85), (0.99, 0.68, 0.38), (0.45, 0.68, 0.82), (0.11, 0.23, 0.34)]
low, high = sorted(volumes)[len(volumes) // 20], sorted(volumes)[-len(volumes) // 20]
for k, color in enumerate(ramp):
    table.AddRGBPoint(low + (high - low) * k / (len(ramp) - 1), *color)
mapper.SetLookupTable(table)
solid.GetProperty().SetAmbient(0.25)
solid.GetProperty().SetDiffuse(0.8)
lines = vtk.vtkPolyData()
lines.SetPoints(points)
lines.SetLines(edges)
_, borders = actor(lines)
borders.GetProperty().SetColor(0.1, 0.15, 0.2)
borders.GetProperty().SetLineWidth(1.5)

renderer = vtk.vtkRenderer()
renderer.AddActor(solid)
renderer.AddActor(borders)
renderer.SetBackground(1, 1, 1)
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetMultiSamples(8)
window.SetSize(900, 800)
window.AddRenderer(renderer)
camera = renderer.GetActiveCamera()
camera.SetPosition(middle[0] + 2.6, middle[1] - 3.0, middle[2] + 2.0)
camera.SetFocalPoint(*middle)
camera.SetViewUp(0, 0, 1)
renderer.ResetCamera()
camera.Zoom(1.08)
window.Render()
shot = vtk.vtkWindowToImageFilter()
shot.SetInput(window)
shot.ReadFrontBufferOff()
writer = vtk.vtkPNGWriter()
writer.SetFileName(sys.argv[2])
writer.SetInputConnection(shot.GetOutputPort())
writer.Write()
