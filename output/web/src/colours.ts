/** Viridis and cividis: even in lightness, and the same to the colour-blind (van der Walt & Smith 2015; Nuñez 2018). */

export type Rgb = [number, number, number];
export type ColourMap = (share: number) => Rgb;

function through(anchors: string): ColourMap {
  const colours = anchors.split(' ').map((hex) => [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16)) as Rgb);
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

/** One colour for each of n courses, all of them legible on the theme's ground. */
export function courseColours(n: number, dark: boolean): string[] {
  const [from, to] = dark ? [0.28, 1.0] : [0.0, 0.84];
  return Array.from({length: n}, (_, i) => css(viridis(from + (n > 1 ? (i / (n - 1)) * (to - from) : 0.45))));
}

/** One colour for each data set: ink for the reference, then Okabe and Ito's (2008). */
export function setColours(n: number, dark: boolean): string[] {
  const others = dark ? ['#56b4e9', '#e69f00', '#cc79a7', '#2fbf91'] : ['#0072b2', '#c26a00', '#a8507f', '#00795a'];
  return [dark ? '#e6eaed' : '#1c2126', ...Array.from({length: n}, (_, i) => others[i % others.length]!)].slice(0, n);
}

export function gradient(map: ColourMap): string {
  return Array.from({length: 11}, (_, i) => css(map(i / 10))).join(',');
}
