BOARD "S3C44B0X board: three keys, four LEDs"
# Keys and LEDs are on at the low level. The names are those that the board's
# device tree must give to its lines (docs/boards.md).

%IX0.0  gpio  line=KEY1  active-low debounce=10ms
%IX0.1  gpio  line=KEY2  active-low debounce=10ms
%IX0.2  gpio  line=KEY3  active-low debounce=10ms

%QX0.0  gpio  line=LED1  active-low safe=0
%QX0.1  gpio  line=LED2  active-low safe=0
%QX0.2  gpio  line=LED3  active-low safe=0
%QX0.3  gpio  line=LED4  active-low safe=0
