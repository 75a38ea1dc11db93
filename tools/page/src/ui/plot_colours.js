// Colours of series that the colour-blind tell apart (after Okabe and Ito), on light and on dark ground.

const colours = {
  light: ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#b38600', '#3c9bd1', '#444444', '#8a4fbf'],
  dark: ['#56b4e9', '#ff8c42', '#2dc79b', '#e59bc4', '#e5c100', '#8fd0ff', '#d0d0d0', '#b794f6'],
};

export const series_colour = (theme, i) => colours[theme][i % colours[theme].length];
