BOARD "BeagleBone Black"
# Lines are named after header and pin. A pull must come from a resistor or the
# device tree: the chip's driver does not set it (docs/boards.md).

%IX0.0  gpio  line=P8_11  active-low debounce=5ms
%IX0.1  gpio  line=P8_12  active-low debounce=5ms
%IX0.2  gpio  line=P8_15  active-low debounce=5ms
%IX0.3  gpio  line=P8_16  active-low debounce=5ms

%QX0.0  gpio  line=P9_12  safe=0
%QX0.1  gpio  line=P9_23  safe=0
%QX0.2  gpio  line=P8_14  safe=0
%QX0.3  gpio  line=P8_17  safe=0
