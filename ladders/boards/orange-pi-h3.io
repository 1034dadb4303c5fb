BOARD "Orange Pi One, PC, Lite (Allwinner H3)"
# Lines have no names: the chip's label and an offset. Offset = 32 * port + number,
# A is port 0: PA7 is 7, PG6 is 6 * 32 + 6 = 198.

%IX0.0  gpio  chip=1c20800.pinctrl offset=7    pull-up active-low debounce=5ms   # PA7,  pin 29
%IX0.1  gpio  chip=1c20800.pinctrl offset=8    pull-up active-low debounce=5ms   # PA8,  pin 31
%IX0.2  gpio  chip=1c20800.pinctrl offset=9    pull-up active-low debounce=5ms   # PA9,  pin 33
%IX0.3  gpio  chip=1c20800.pinctrl offset=10   pull-up active-low debounce=5ms   # PA10, pin 35

%QX0.0  gpio  chip=1c20800.pinctrl offset=20   safe=0   # PA20, pin 37
%QX0.1  gpio  chip=1c20800.pinctrl offset=198  safe=0   # PG6,  pin 38
%QX0.2  gpio  chip=1c20800.pinctrl offset=199  safe=0   # PG7,  pin 40
%QX0.3  gpio  chip=1c20800.pinctrl offset=200  safe=0   # PG8,  pin 32
