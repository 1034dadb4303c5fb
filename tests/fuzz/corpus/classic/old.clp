_FILES_CLASSICLADDER
_FILE-timers.csv
; Timers :
; Base,Preset
0,2
1,5
_/FILE-timers.csv
_FILE-arithmetic_expressions.csv
; Arithmetic expressions :
@200/0@:=@200/0@+1

@200/0@>10


_/FILE-arithmetic_expressions.csv
_FILE-rung_3.csv
; Rung :
#VER=2.0
#LABEL=
#COMMENT=
#PREVRUNG=-1
#NEXTRUNG=-1
1-0-50/0 , 9-0-0/0 , 9-0-0/0 , 9-0-0/0 , 9-0-0/0 , 9-0-0/0 , 9-0-0/0 , 9-0-0/0 , 9-0-0/0 , 50-0-60/0
_/FILE-rung_3.csv
_FILE-rung_7.csv
; Rung :
#VER=2.0
#LABEL=
#COMMENT=
#PREVRUNG=-1
#NEXTRUNG=-1
99-0-0/0 , 99-0-0/0 , 20-0-0/2 , 9-0-0/0 , 9-0-0/0 , 9-0-0/0 , 9-0-0/0 , 9-0-0/0 , 9-0-0/0 , 103-0-0/0
_/FILE-rung_7.csv
_/FILES_CLASSICLADDER
