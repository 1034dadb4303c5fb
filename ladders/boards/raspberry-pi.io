BOARD "Raspberry Pi with 40 pins: 1B+, 2, 3, 4, 5, Zero"
# Line names are the same on all of them, whatever chip is behind (docs/boards.md).
# Inputs: a contact from the pin to ground. Outputs: 3.3 V, to a driver or relay board.

%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms   # pin 11
%IX0.1  gpio  line=GPIO27  pull-up active-low debounce=5ms   # pin 13
%IX0.2  gpio  line=GPIO22  pull-up active-low debounce=5ms   # pin 15
%IX0.3  gpio  line=GPIO5   pull-up active-low debounce=5ms   # pin 29
%IX0.4  gpio  line=GPIO6   pull-up active-low debounce=5ms   # pin 31
%IX0.5  gpio  line=GPIO13  pull-up active-low debounce=5ms   # pin 33
%IX0.6  gpio  line=GPIO19  pull-up active-low debounce=5ms   # pin 35
%IX0.7  gpio  line=GPIO26  pull-up active-low debounce=5ms   # pin 37

%QX0.0  gpio  line=GPIO23  safe=0   # pin 16
%QX0.1  gpio  line=GPIO24  safe=0   # pin 18
%QX0.2  gpio  line=GPIO25  safe=0   # pin 22
%QX0.3  gpio  line=GPIO12  safe=0   # pin 32
%QX0.4  gpio  line=GPIO16  safe=0   # pin 36
%QX0.5  gpio  line=GPIO20  safe=0   # pin 38
%QX0.6  gpio  line=GPIO21  safe=0   # pin 40
%QX0.7  gpio  line=GPIO18  safe=0   # pin 12
