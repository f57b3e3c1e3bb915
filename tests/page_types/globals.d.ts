// What the page's scripts find in the window besides the browser's own (third_party/uplot).
declare const uPlot: any;
