#include "output/vtk_page.h"

#include <algorithm>
#include <fmt/core.h>
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include "output/viridis.h"

namespace thermotwin::output {
void set_viridis(vtkLookupTable& table, Ticks const& ticks) {
  constexpr int n_colours = 256;
  table.SetNumberOfTableValues(n_colours);
  for (int i = 0; i < n_colours; ++i) {
    auto const [r, g, b] = viridis(i / (n_colours - 1.0));
    table.SetTableValue(i, r, g, b);
  }
  table.SetTableRange(ticks.first, ticks.first + (ticks.count - 1) * ticks.step);
}

void set_style(vtkTextProperty& text, int size, bool bold) {
  text.SetFontFamilyToArial();
  text.SetFontSize(size);
  text.SetBold(bold);
  text.SetItalic(false);
  text.SetShadow(false);
  text.SetColor(ink[0], ink[1], ink[2]);
}

int Page::scaled(double pixels) const { return std::max(1, static_cast<int>(pixels * height_ / 1000.0 + 0.5)); }

void Page::add_line(std::string const& text, int size, bool bold) {
  top_ += 1.35 * size;
  add_label(text, scaled(36), height_ - scaled(top_), size, bold);
}

void Page::add_colour_bar(vtkLookupTable& colours, Ticks const& ticks, std::string const& title) {
  int const left = width_ - scaled(180), width = scaled(34);
  int const bottom = height_ / 6, top = height_ - height_ / 5;
  add_strip(colours, left, width, bottom, top);
  for (int i = 0; i < ticks.count; ++i) {
    int const y = bottom + (top - bottom) * i / (ticks.count - 1);
    std::string const number = fmt::format("{:.{}f}", ticks.first + i * ticks.step, ticks.decimals);
    add_tick(left + width, y);
    add_label(number, left + width + scaled(18), y, 24).SetVerticalJustificationToCentered();
  }
  add_label(title, left + width / 2, top + scaled(24), 26).SetJustificationToCentered();
}

vtkTextProperty& Page::add_label(std::string const& text, int x, int y, int size, bool bold) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  set_style(*actor->GetTextProperty(), scaled(size), bold);
  actor->SetPosition(x, y);
  renderer_.AddActor2D(actor);
  return *actor->GetTextProperty();
}

void Page::add_strip(vtkLookupTable& colours, int left, int width, int bottom, int top) {
  vtkNew<vtkPoints> corners;
  vtkNew<vtkCellArray> bands;
  vtkNew<vtkDoubleArray> values;
  vtkIdType const n = colours.GetNumberOfTableValues();
  double const low = colours.GetTableRange()[0], high = colours.GetTableRange()[1];
  for (vtkIdType i = 0; i <= n; ++i) {
    double const y = bottom + (top - bottom) * static_cast<double>(i) / static_cast<double>(n);
    corners->InsertNextPoint(left, y, 0);
    corners->InsertNextPoint(left + width, y, 0);
    if (i == n) break;
    bands->InsertNextCell({2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2});
    values->InsertNextValue(low + (high - low) * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
  }
  vtkNew<vtkPolyData> strip;
  strip->SetPoints(corners);
  strip->SetPolys(bands);
  strip->GetCellData()->SetScalars(values);
  add_flat(*strip, &colours);
}

void Page::add_tick(int x, int y) {
  vtkNew<vtkPoints> ends;
  ends->InsertNextPoint(x, y, 0);
  ends->InsertNextPoint(x + scaled(9), y, 0);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({0, 1});
  vtkNew<vtkPolyData> tick;
  tick->SetPoints(ends);
  tick->SetLines(lines);
  add_flat(*tick, nullptr);
}

void Page::add_flat(vtkPolyData& shape, vtkLookupTable* colours) {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(&shape);
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(ink[0], ink[1], ink[2]);
  actor->GetProperty()->SetLineWidth(static_cast<float>(scaled(2)));
  renderer_.AddActor2D(actor);
}

}  // namespace thermotwin::output
