BOARD "cut"
%QX0.0 sim safe=0
