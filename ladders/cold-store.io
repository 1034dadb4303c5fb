BOARD "Raspberry Pi, Cold store"
# Made for the 40 pins; other pins are as good. Inputs: a contact from the pin to ground.

%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms  # DoorOpen
%IX0.1  gpio  line=GPIO27  pull-up active-low debounce=5ms  # CompressorOk
%IX0.2  gpio  line=GPIO22  pull-up active-low debounce=5ms  # Acknowledge

%QX0.0  gpio  line=GPIO23  safe=0  # Cooling
%QX0.1  gpio  line=GPIO24  safe=0  # Lamp
%QX0.2  gpio  line=GPIO25  safe=0  # Horn

# DS18B20 on 1-wire (docs/field.md); its number is in /sys/bus/w1/devices.
%IW2  w1  sensor=28-000005e2fdc3  range=-550..1250 at -55C..125C  stale=10s
