BOARD "Raspberry Pi, Weigh sorter"
# Made for the 40 pins; other pins are as good. Inputs: a contact from the pin to ground.

%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms  # StopOk
%IX0.1  gpio  line=GPIO27  pull-up active-low debounce=5ms  # Start
%IX0.2  gpio  line=GPIO22  pull-up active-low debounce=5ms  # Barrier
%IX0.3  gpio  line=GPIO5   pull-up active-low debounce=5ms  # Encoder

%QX0.0  gpio  line=GPIO23  safe=0  # Belt
%QX0.1  gpio  line=GPIO24  safe=0  # Pusher[0]
%QX0.2  gpio  line=GPIO25  safe=0  # Pusher[1]
%QX0.3  gpio  line=GPIO12  safe=0  # Pusher[2]
%QX0.4  gpio  line=GPIO16  safe=0  # Crowded

# ADS1115 on I2C (docs/field.md); the amplifier of the scale gives 0 to 3 V for 0 to 3 kg.
%IW2  iio  device=ads1015 channel=voltage0  range=0..30000 at 0V..3V  poll=10ms substitute=hold
