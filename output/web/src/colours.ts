/** Viridis and cividis: even in lightness, and the same to the colour-blind (van der Walt & Smith 2015; Nuñez 2018). */

export type Rgb = [number, number, number];
export type ColourMap = (share: number) => Rgb;

const rgb = (list: string): Rgb[] => list.split(' ').map((hex) => [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16)) as Rgb);

function through(anchors: string): ColourMap {
  const colours = rgb(anchors);
  return (share) => {
    const x = Math.min(1, Math.max(0, share)) * (colours.length - 1);
    const i = Math.min(colours.length - 2, Math.floor(x));
    const a = colours[i]!, b = colours[i + 1]!;
    return [0, 1, 2].map((c) => a[c]! + (x - i) * (b[c]! - a[c]!)) as Rgb;
  };
}

export const viridis = through('440154 482475 414487 355f8d 2a788e 21918c 22a884 44bf70 7ad151 bddf26 fde725');
export const cividis = through('00224e 123570 3b496c 575d6d 707173 8a8678 a59c74 c3b369 e1cc55 fee838');

/** Of viridis what is seen as a thin line on white and on dark ground. */
export const viridisLines: ColourMap = (share) => viridis(0.3 + 0.67 * Math.min(1, Math.max(0, share)));

export function css([r, g, b]: Rgb, alpha = 1): string {
  return `rgba(${Math.round(r)},${Math.round(g)},${Math.round(b)},${alpha})`;
}

export interface LineStyle {
  colour: string;
  dash?: number[];
}

/** Okabe and Ito's (2008) without yellow, which `figure` draws in (output/figure.h); on dark ground the same, lighter. */
const distinct = {
  light: rgb('000000 0073b3 d65e00 009e73 cc78a6 57b5e8 e69e00'),
  dark: rgb('e6eaed 3a93d6 f0783c 1fb58a dd94bd 93d2f5 eab52e'),
};
const card: {light: Rgb; dark: Rgb} = {light: [255, 255, 255], dark: [23, 28, 33]};

/**
 * One style for each of n courses: seven colours, then the same dashed, then dotted, or, where dashes tell data sets
 * apart, then the same pale. More than there are of these go through viridis.
 */
export function courseStyles(n: number, several: boolean, dark: boolean): LineStyle[] {
  const theme = dark ? 'dark' : 'light', colours = distinct[theme], dashes = several ? [undefined, undefined] : [undefined, [6, 4], [2, 3]];
  if (n <= colours.length * dashes.length)
    return Array.from({length: n}, (_, i) => {
      const turn = Math.floor(i / colours.length), colour = colours[i % colours.length]!;
      const pale = colour.map((c, k) => 0.5 * (c + card[theme][k]!)) as Rgb;
      return {colour: css(several && turn > 0 ? pale : colour), dash: dashes[turn]};
    });
  const [from, to] = dark ? [0.28, 1.0] : [0.0, 0.84];
  return Array.from({length: n}, (_, i) => ({colour: css(viridis(from + (i / (n - 1)) * (to - from)))}));
}

/** The background of a small field beside a name: a piece of the line. */
export function swatch({colour, dash}: LineStyle): string {
  if (!dash) return colour;
  const [on, off] = dash.map((length) => length / 2) as [number, number];
  return `repeating-linear-gradient(to right, ${colour} 0 ${on}px, transparent ${on}px ${on + off}px)`;
}

/** One colour for each data set: ink for the reference, then Okabe and Ito's (2008). */
export function setColours(n: number, dark: boolean): string[] {
  const others = dark ? ['#56b4e9', '#e69f00', '#cc79a7', '#2fbf91'] : ['#0072b2', '#c26a00', '#a8507f', '#00795a'];
  return [dark ? '#e6eaed' : '#1c2126', ...Array.from({length: n}, (_, i) => others[i % others.length]!)].slice(0, n);
}

export function gradient(map: ColourMap): string {
  return Array.from({length: 11}, (_, i) => css(map(i / 10))).join(',');
}
