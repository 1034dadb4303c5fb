BOARD "16 inputs, 16 outputs"
%IX0.0 gpio chip=wide offset=0
%IX0.1 gpio chip=wide offset=1
%IX0.2 gpio chip=wide offset=2
%IX0.3 gpio chip=wide offset=3
%IX0.4 gpio chip=wide offset=4
%IX0.5 gpio chip=wide offset=5
%IX0.6 gpio chip=wide offset=6
%IX0.7 gpio chip=wide offset=7
%IX1.0 gpio chip=wide offset=8
%IX1.1 gpio chip=wide offset=9
%IX1.2 gpio chip=wide offset=10
%IX1.3 gpio chip=wide offset=11
%IX1.4 gpio chip=wide offset=12
%IX1.5 gpio chip=wide offset=13
%IX1.6 gpio chip=wide offset=14
%IX1.7 gpio chip=wide offset=15
%QX0.0 gpio chip=wide offset=16 safe=0
%QX0.1 gpio chip=wide offset=17 safe=0
%QX0.2 gpio chip=wide offset=18 safe=0
%QX0.3 gpio chip=wide offset=19 safe=0
%QX0.4 gpio chip=wide offset=20 safe=0
%QX0.5 gpio chip=wide offset=21 safe=0
%QX0.6 gpio chip=wide offset=22 safe=0
%QX0.7 gpio chip=wide offset=23 safe=0
%QX1.0 gpio chip=wide offset=24 safe=0
%QX1.1 gpio chip=wide offset=25 safe=0
%QX1.2 gpio chip=wide offset=26 safe=0
%QX1.3 gpio chip=wide offset=27 safe=0
%QX1.4 gpio chip=wide offset=28 safe=0
%QX1.5 gpio chip=wide offset=29 safe=0
%QX1.6 gpio chip=wide offset=30 safe=0
%QX1.7 gpio chip=wide offset=31 safe=0
