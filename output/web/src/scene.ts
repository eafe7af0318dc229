// The only file that knows vtk.js.
import '@kitware/vtk.js/Rendering/OpenGL/Profiles/Geometry';
import vtkActor from '@kitware/vtk.js/Rendering/Core/Actor';
import vtkColorTransferFunction from '@kitware/vtk.js/Rendering/Core/ColorTransferFunction';
import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray';
import vtkMapper from '@kitware/vtk.js/Rendering/Core/Mapper';
import vtkOpenGLRenderWindow from '@kitware/vtk.js/Rendering/OpenGL/RenderWindow';
import vtkPoints from '@kitware/vtk.js/Common/Core/Points';
import vtkPolyData from '@kitware/vtk.js/Common/DataModel/PolyData';
import vtkRenderWindow from '@kitware/vtk.js/Rendering/Core/RenderWindow';
import vtkRenderer from '@kitware/vtk.js/Rendering/Core/Renderer';
import type {Camera} from './camera';
import {viridis, type Rgb} from './colours';

const share = (colour: Rgb): Rgb => colour.map((c) => c / 255) as Rgb;

function withSizes(indices: ArrayLike<number>, each: number): Uint32Array {
  const cells = new Uint32Array((indices.length / each) * (each + 1));
  for (let i = 0, at = 0; i < indices.length; i += each) {
    cells[at++] = each;
    for (let k = 0; k < each; ++k) cells[at++] = indices[i + k]!;
  }
  return cells;
}

/** A surface coloured by a number per point, its edges, and the edges of one part of it in another colour. */
export class Scene {
  /** To be changed in place; then call `changed`. */
  readonly points: Float32Array;
  readonly values: Float32Array;

  private readonly window = vtkRenderWindow.newInstance();
  private readonly renderer = vtkRenderer.newInstance();
  private readonly view = vtkOpenGLRenderWindow.newInstance();
  private readonly corners = vtkPoints.newInstance();
  private readonly scalars: vtkDataArray;
  private readonly surface = vtkPolyData.newInstance();
  private readonly lines = vtkPolyData.newInstance();
  private readonly chosen = vtkPolyData.newInstance();
  private readonly colours = vtkColorTransferFunction.newInstance();
  private readonly faces = vtkActor.newInstance();
  private readonly edges = vtkActor.newInstance();
  private readonly mark = vtkActor.newInstance();

  constructor(host: HTMLElement, points: Float32Array, triangles: ArrayLike<number>, edges: ArrayLike<number>,
              range: [number, number] | null) {
    this.points = points.slice();
    this.values = new Float32Array(points.length / 3);
    this.window.addRenderer(this.renderer);
    this.window.addView(this.view);
    this.view.setContainer(host);
    this.corners.setData(this.points, 3);
    this.scalars = vtkDataArray.newInstance({name: 'temperature', values: this.values, numberOfComponents: 1});

    this.surface.setPoints(this.corners);
    this.surface.getPolys().setData(withSizes(triangles, 3));
    this.surface.getPointData().setScalars(this.scalars);
    this.faces.setMapper(this.mapper(this.surface, range));
    this.faces.getProperty().setAmbient(0.6);
    this.faces.getProperty().setDiffuse(0.45);

    for (const [data, actor, width] of [[this.lines, this.edges, 1], [this.chosen, this.mark, 3]] as const) {
      data.setPoints(this.corners);
      actor.setMapper(this.mapper(data, null));
      actor.getProperty().setLighting(false);
      actor.getProperty().setLineWidth(width);
    }
    this.lines.getLines().setData(withSizes(edges, 2));
    for (const actor of [this.faces, this.edges, this.mark]) this.renderer.addActor(actor);
  }

  private mapper(data: vtkPolyData, range: [number, number] | null): vtkMapper {
    const mapper = vtkMapper.newInstance({interpolateScalarsBeforeMapping: true, useLookupTableScalarRange: true});
    mapper.setInputData(data);
    mapper.setScalarVisibility(range !== null);
    if (range) {
      this.spread(range);
      mapper.setLookupTable(this.colours);
      mapper.setResolveCoincidentTopologyToPolygonOffset();
    }
    return mapper;
  }

  /** The colours over these values. */
  spread([low, high]: [number, number]): void {
    this.colours.removeAllPoints();
    for (let i = 0; i <= 20; ++i) this.colours.addRGBPoint(low + (i / 20) * (high - low), ...share(viridis(i / 20)));
  }

  /** The faces to draw: what is hidden anyway need not be. */
  show(triangles: ArrayLike<number>): void {
    this.surface.getPolys().setData(withSizes(triangles, 3));
    this.surface.modified();
  }

  /** Edges of a part: pairs of points. */
  choose(edges: ArrayLike<number>): void {
    this.chosen.getLines().setData(withSizes(edges, 2));
    this.chosen.modified();
  }

  paint(ground: Rgb, faces: Rgb, edges: Rgb, mark: Rgb): void {
    this.renderer.setBackground(...share(ground));
    this.faces.getProperty().setColor(...share(faces));
    this.edges.getProperty().setColor(...share(edges));
    this.mark.getProperty().setColor(...share(mark));
  }

  changed(moved: boolean): void {
    this.scalars.modified();
    if (moved) {
      this.corners.modified();
      this.lines.modified();
      this.chosen.modified();
    }
    this.surface.modified();
  }

  resize(width: number, height: number): void {
    this.view.setSize(Math.max(1, Math.round(width)), Math.max(1, Math.round(height)));
  }

  /** What was drawn last; only right after it, before the browser has shown it. */
  copyTo(still: HTMLCanvasElement): void {
    const drawn = this.view.getCanvas()!;
    [still.width, still.height] = [drawn.width, drawn.height];
    still.getContext('2d')?.drawImage(drawn, 0, 0);
  }

  draw(camera: Camera): void {
    const active = this.renderer.getActiveCamera(), far = 20 * camera.scale, towards = camera.towards;
    active.setParallelProjection(true);
    active.setParallelScale(camera.scale);
    active.setFocalPoint(...camera.focus);
    active.setPosition(camera.focus[0] + far * towards[0], camera.focus[1] + far * towards[1],
                       camera.focus[2] + far * towards[2]);
    active.setViewUp(...camera.axes.above);
    this.renderer.resetCameraClippingRange();
    this.window.render();
  }
}
