#include "output/vtk_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vtkAxesActor.h>
#include <vtkCamera.h>
#include <vtkCaptionActor2D.h>
#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

namespace thermotwin::output {

Eigen::Matrix3d axes_of_view(Eigen::Vector3d const& up) {
  Eigen::Matrix3d axes;
  axes.col(2) = up;
  axes.col(0) = up.x() == 0.0 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

void aim(vtkRenderer& renderer, Eigen::Matrix3Xd const& points, Eigen::Vector3d const& upwards, double aspect,
         ViewFrame const& frame) {
  auto const [left, right, bottom, top] = frame;
  Eigen::Vector3d const towards_viewer = axes_of_view(upwards) * Eigen::Vector3d(0.75, -1.0, 0.62).normalized();
  Eigen::Vector3d const across = upwards.cross(towards_viewer).normalized();
  Eigen::Vector3d const up = towards_viewer.cross(across);
  Eigen::RowVectorXd const x = across.transpose() * points, y = up.transpose() * points;
  double const scale = std::max((y.maxCoeff() - y.minCoeff()) / (top - bottom),
                                (x.maxCoeff() - x.minCoeff()) / ((right - left) * aspect)) /
                       2;
  double const x_middle = (x.maxCoeff() + x.minCoeff()) / 2 - scale * aspect * (left + right - 1);
  double const y_middle = (y.maxCoeff() + y.minCoeff()) / 2 - scale * (bottom + top - 1);
  Eigen::Vector3d const focus = x_middle * across + y_middle * up;
  double const distance = 10 * scale;  // in front of everything; parallel, so it changes nothing else
  auto& camera = *renderer.GetActiveCamera();
  camera.ParallelProjectionOn();
  camera.SetParallelScale(scale);
  camera.SetFocalPoint(focus.data());
  camera.SetPosition(Eigen::Vector3d(focus + distance * towards_viewer).data());
  camera.SetViewUp(upwards.data());
  renderer.ResetCameraClippingRange();
}

void add_axes(vtkRenderWindow& window, vtkCamera& camera, int font_size) {
  vtkNew<vtkRenderer> corner;
  corner->SetViewport(0.0, 0.0, 0.11, 0.17);
  corner->SetLayer(1);
  corner->InteractiveOff();
  vtkNew<vtkAxesActor> axes;
  axes->SetConeRadius(0.3);
  for (auto* shaft : {axes->GetXAxisShaftProperty(), axes->GetYAxisShaftProperty(), axes->GetZAxisShaftProperty(),
                      axes->GetXAxisTipProperty(), axes->GetYAxisTipProperty(), axes->GetZAxisTipProperty()}) {
    shaft->SetColor(faint_ink[0], faint_ink[1], faint_ink[2]);
    shaft->SetLineWidth(3);
  }
  for (auto* caption :
       {axes->GetXAxisCaptionActor2D(), axes->GetYAxisCaptionActor2D(), axes->GetZAxisCaptionActor2D()}) {
    caption->GetTextActor()->SetTextScaleModeToNone();
    set_style(*caption->GetCaptionTextProperty(), font_size, true);
  }
  corner->AddActor(axes);
  corner->GetActiveCamera()->ParallelProjectionOn();
  corner->GetActiveCamera()->SetPosition(camera.GetDirectionOfProjection()[0] * -1,
                                         camera.GetDirectionOfProjection()[1] * -1,
                                         camera.GetDirectionOfProjection()[2] * -1);
  corner->GetActiveCamera()->SetFocalPoint(0, 0, 0);
  corner->GetActiveCamera()->SetViewUp(camera.GetViewUp());
  corner->ResetCamera();
  corner->GetActiveCamera()->Zoom(0.9);
  window.AddRenderer(corner);
}

std::string as_png(vtkRenderWindow* window) {
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> mean;
  mean->SetInputConnection(image->GetOutputPort());
  mean->SetShrinkFactors(oversampling, oversampling, 1);
  mean->AveragingOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(mean->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  auto* const bytes = writer->GetResult();
  return {reinterpret_cast<char const*>(bytes->GetPointer(0)), static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

}  // namespace thermotwin::output
