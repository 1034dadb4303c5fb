BOARD "Orange Pi Zero 2 (Allwinner H616)"
# Offset = 32 * port + number: PC9 is 2 * 32 + 9 = 73.

%IX0.0  gpio  chip=300b000.pinctrl offset=73  pull-up active-low debounce=5ms   # PC9,  pin 7
%IX0.1  gpio  chip=300b000.pinctrl offset=70  pull-up active-low debounce=5ms   # PC6,  pin 11
%IX0.2  gpio  chip=300b000.pinctrl offset=69  pull-up active-low debounce=5ms   # PC5,  pin 13
%IX0.3  gpio  chip=300b000.pinctrl offset=72  pull-up active-low debounce=5ms   # PC8,  pin 15

%QX0.0  gpio  chip=300b000.pinctrl offset=75  safe=0   # PC11, pin 12
%QX0.1  gpio  chip=300b000.pinctrl offset=79  safe=0   # PC15, pin 16
%QX0.2  gpio  chip=300b000.pinctrl offset=78  safe=0   # PC14, pin 18
%QX0.3  gpio  chip=300b000.pinctrl offset=71  safe=0   # PC7,  pin 22
