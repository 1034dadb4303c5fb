BOARD "Raspberry Pi 1 A and B with 26 pins"
# Only lines that both revisions of the board have.

%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms   # pin 11
%IX0.1  gpio  line=GPIO18  pull-up active-low debounce=5ms   # pin 12
%IX0.2  gpio  line=GPIO22  pull-up active-low debounce=5ms   # pin 15

%QX0.0  gpio  line=GPIO23  safe=0   # pin 16
%QX0.1  gpio  line=GPIO24  safe=0   # pin 18
%QX0.2  gpio  line=GPIO25  safe=0   # pin 22
