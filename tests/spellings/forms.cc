#include "tests/spellings/forms.h"

namespace ncport::tests {
namespace {

constexpr Form kForms[] = {
    // 1: words run together with expressions
    {"1", "G1 X = R24 + R106 F = R9 * 2", "G1X=R24+R106F=R9*2"},
    {"1", "G0 G90 X = R24 Y = R25", "G0G90X=R24Y=R25"},
    {"1", "G75 X0 M11", "G75X0M11"},
    {"1", "G1 X10 F100.", "G1X10F100."},
    {"1", "N10 G0 G54 X-10 Y.20 Z30.4 T1 S400.0 M3", "N10G0G54X-10Y.20Z30.4T1S400.0M3"},
    {"1", "G1 Z = ENDPZ", "G1Z=ENDPZ"},
    {"1", "X = - ( R1 + 2 ) Y = R2 / 4 - 1", "X=-(R1+2)Y=R2/4-1"},
    {"1", "G2 X = R1 Y = R2 I = - R3 J = 4 - 12.5", "G2X=R1Y=R2I=-R3J=4-12.5"},
    {"1", "G3 X10 Y0 CR = 5.5", "G3 X10 Y0 CR=5.5"},
    {"1", "X = 10 * ( 5 + SIN ( 37.5 ) ) Z5", "X=10*(5+SIN(37.5))Z5"},
    {"1", "G96 S300 LIMS = 3200 M3", "G96 S300 LIMS=3200 M3"},
    // 2: two conditional jumps in one block
    {"2", "IF R1 == 0 GOTOF LAB1 IF R1 == R2 GOTOF LAB2\nLAB1: R3 = 1\nLAB2: R3 = 2",
     "IF R1==0 GOTOF LAB1 IF R1==R2 GOTOF LAB2\nLAB1: R3=1\nLAB2: R3=2"},
    {"2",
     "IF A_1 == 0 GOTOF LAB1 IF A_1 == B_1 GOTOF LAB1\nLAB1:", "IF A_1==0 GOTOF LAB1 IF A_1==B_1 GOTOF LAB1\nLAB1:"},
    // 3: label and statement
    {"3", "LAB1: X = 5", "LAB1:X=5"},
    {"3", "N10 LAB1: G1 X20", "N10 LAB1:G1 X20"},
    {"3", "N40 TR789: G0 X10 Z20", "N40 TR789:G0X10Z20"},
    // 4: several assignments
    {"4", "NUM_1 = 1 HZ_2 = NUM_1 - 1 CC_1 = ABS ( CC_1 )", "NUM_1=1 HZ_2=NUM_1-1 CC_1=ABS(CC_1)"},
    {"4", "R1 = 5 R2 = R1 + 1 G1 X = R2", "R1=5 R2=R1+1 G1 X=R2"},
    {"4", "T = NAME_1 [ R1 ] D = EDGE_1 [ R1 ]", "T=NAME_1[R1] D=EDGE_1[R1]"},
    {"4", "M = VAR_1", "M=VAR_1"},
    {"4", "S = SPEED_1 M3", "S=SPEED_1 M3"},
    {"4", "M = QU ( 5 )", "M=QU(5)"},
    {"4", "T = \"ROUGH_T80 A\" D1", "T=\"ROUGH_T80 A\" D1"},
    {"4", "S2 = 500 M2 = 3", "S2=500 M2=3"},
    // 5: text operator, returns to a label, indirect calls
    {"5", "SETAL ( 65000 , << ( N_1 + 1 ) )", "SETAL(65000,<<(N_1+1))"},
    {"5", "RET ( \"LAB1\" )", "RET(\"LAB1\")"},
    {"5", "CALL NAME_1", "CALL NAME_1"},
    {"5", "CALL \"L\" << R1", "CALL \"L\"<<R1"},
    {"5", "GOTOF \"LBL\" << R1", "GOTOF \"LBL\"<<R1"},
    // 6: definition files
    {"6", "DEF CHAN REAL X_1 , Y_1 = 2.5", "DEF CHAN REAL X_1,Y_1=2.5"},
    {"6", "DEF NCK INT COUNT_1", "DEF NCK INT COUNT_1"},
    // 7: headers and calls with arguments
    {"7", "PROC PP_1 ( VAR REAL A_1 [ 3 ] )\nRET", "PROC PP_1(VAR REAL A_1[3])\nRET"},
    {"7", "PROC NAME_1 ( INT A_1 )\nRET", "PROC  NAME_1 (INT A_1)\nRET"},
    {"7", "; remark\nN5 PROC NAME_1 ( INT A_1 , STRING [ 20 ] T_1 ) SAVE DISPLOF\nN10 M17",
     "; remark\nN5 PROC NAME_1(INT A_1,STRING[20] T_1) SAVE DISPLOF\nN10 M17"},
    {"7", "FF_1 ( , , , 10 )", "FF_1(,,,10)"},
    {"7", "FF_1 ( 1 , \"x\" , \"\" , , )", "FF_1(1,\"x\",\"\",,)"},
    {"7", "FF_1 ( 1 , 2 ) P = 3", "FF_1(1,2) P=3"},
    {"7", "EXTERN FF_1 ( REAL , VAR INT , REAL [ 3 ] )", "EXTERN FF_1(REAL,VAR INT,REAL[3])"},
    {"7", "CYCLE_X ( 1 , 2 , 3 , 4 , 5 , 6 , 7 , 8 , 9 , 10 , 11 , 12 , 13 , 14 , 15 , 16 )",
     "CYCLE_X(1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16)"},
    {"7", "MCALL CYCLE81 ( 10 , 0 , 2 , , 15 )\nX10 Y0\nMCALL", "MCALL CYCLE81(10,0,2,,15)\nX10Y0\nMCALL"},
    // 8: conditions without blanks
    {"8", "IF ( R1 <= 1 ) AND ( R1 > 0.001 ) GOTOF LAB1\nLAB1:", "IF (R1<=1)AND(R1>0.001) GOTOF LAB1\nLAB1:"},
    {"8", "IF ( R1 == 1 ) GOTOF LAB1\nLAB1:", "IF(R1==1)GOTOF LAB1\nLAB1:"},
    {"8", "IF R2 >= 0 GOTOB LAB1", "IF R2>=0 GOTOB LAB1"},
    {"8", "IF NOT ( R1 == 1 ) OR R2 GOTOF LAB1\nLAB1:", "IF NOT(R1==1)OR R2 GOTOF LAB1\nLAB1:"},
    // 9: axes by name
    {"9", "AX [ N_1 ] = 10 G0", "AX[N_1]=10 G0"},
    // 10: old style
    {"10", "L785 P3", "L785P3"},
    {"10", "L01", "L01"},
    // 11: rounding matters
    {"11", "N_1 = T_1 / 15", "N_1=T_1/15"},
    // 12: frequent words
    {"12 DEF", "DEF REAL A_1 , B_1 = 2 , C_1 [ 2 , 3 ] = SET ( 1 , 2 , , 4 )",
     "DEF REAL A_1,B_1=2,C_1[2,3]=SET(1,2,,4)"},
    {"12 DEF", "DEF STRING [ 40 ] TXT_1 = \"a;b (c)\"", "DEF STRING[40] TXT_1=\"a;b (c)\""},
    {"12 DEF", "DEF BOOL FLAG_1 = TRUE", "DEF BOOL FLAG_1=TRUE"},
    {"12 IF", "IF R1 > 2\nR2 = 1\nELSE\nR2 = 2\nENDIF", "IF R1>2\nR2=1\nELSE\nR2=2\nENDIF"},
    {"12 WHILE", "WHILE R1 < 5\nR1 = R1 + 1\nENDWHILE", "WHILE R1<5\nR1=R1+1\nENDWHILE"},
    {"12 FOR", "FOR R1 = 1 TO R2 + 1\nX = R1\nENDFOR", "FOR R1=1 TO R2+1\nX=R1\nENDFOR"},
    {"12 LOOP", "LOOP\nR1 = R1 + 1\nENDLOOP"},
    {"12 REPEAT", "REPEAT\nR1 = R1 + 1\nUNTIL R1 == 5", "REPEAT\nR1=R1+1\nUNTIL R1==5"},
    {"12 REPEAT", "LAB1: X1\nREPEAT LAB1 P = 2", "LAB1:X1\nREPEAT LAB1 P=2"},
    {"12 REPEAT", "LAB1: X1\nREPEATB LAB1 P = R1 + 1", "LAB1:X1\nREPEATB LAB1 P=R1+1"},
    {"12 CASE", "CASE R1 OF 1 GOTOF LAB1 -2 GOTOB LAB2 DEFAULT GOTOF LAB1\nLAB1:",
     "CASE R1 OF 1 GOTOF LAB1 -2 GOTOB LAB2 DEFAULT GOTOF LAB1\nLAB1:"},
    {"12 MSG", "MSG ( \"R1 is \" << R1 << \" mm\" )", "MSG(\"R1 is \"<<R1<<\" mm\")"},
    {"12 MSG", "MSG ( )", "MSG()"},
    {"12 STOPRE", "STOPRE"},
    {"12 $", "R1 = $AA_IM [ X ] + $AA_IW [ Z ]", "R1=$AA_IM[X]+$AA_IW[Z]"},
    {"12 $", "R1 = $TC_DP3 [ R2 , 1 ] R2 = $P_GG [ 8 ] == 3 R3 = $PI", "R1=$TC_DP3[R2,1]R2=$P_GG[8]==3R3=$PI"},
    {"12 $", "IF $A_IN [ 3 ] == 1 GOTOF LAB1\nLAB1:", "IF $A_IN[3]==1 GOTOF LAB1\nLAB1:"},
    {"12 AC", "G0 X = IC ( 5 ) Y = AC ( R1 ) A = DC ( 90 )", "G0 X=IC(5)Y=AC(R1)A=DC(90)"},
    {"12 AC", "A = ACP ( 90 ) B = ACN ( R1 * 2 )", "A=ACP(90)B=ACN(R1*2)"},
    {"12 TRANS", "TRANS X10 Y = R1", "TRANS X10Y=R1"},
    {"12 TRANS", "ATRANS Z = - R2", "ATRANS Z=-R2"},
    {"12 ROT", "ROT RPL = 45", "ROT RPL=45"},
    {"12 ROT", "AROT Z = R1 / 2", "AROT Z=R1/2"},
    {"12 SCALE", "SCALE X2 Y2", "SCALE X2Y2"},
    {"12 MIRROR", "MIRROR X0", "MIRROR X0"},
    {"12 functions", "R1 = ABS ( R2 ) R3 = TAN ( R4 ) R5 = SQRT ( POT ( R6 ) + POT ( R7 ) )",
     "R1=ABS(R2)R3=TAN(R4)R5=SQRT(POT(R6)+POT(R7))"},
    {"12 functions", "R1 = R2 MOD 360 R3 = TRUNC ( R4 DIV 2 ) R5 = ATAN2 ( R6 , R7 )",
     "R1=R2 MOD 360 R3=TRUNC(R4 DIV 2)R5=ATAN2(R6,R7)"},
    {"12 functions", "R1 = ACOS ( R2 ) R3 = ASIN ( R4 ) R5 = ROUNDUP ( R6 ) R7 = ROUND ( R8 )",
     "R1=ACOS(R2)R3=ASIN(R4)R5=ROUNDUP(R6)R7=ROUND(R8)"},
    {"numbers", "R1 = 1.874EX8 R2 = -.1EX-3 R3 = 'H3C7F' R4 = 'B1001'", "R1=1.874EX8R2=-.1EX-3R3='H3C7F'R4='B1001'"},
    {"numbers", "R [ R5 ] = 27.123 R [ 10 ] = R [ R1 + 1 ]", "R[R5]=27.123R[10]=R[R1+1]"},
    {"dwell", "G4 F = DTB_1", "G4F=DTB_1"},
    {"corner", "G1 X10 CHR = 2\nX10 Y10 RND = 1.5", "G1X10CHR=2\nX10Y10RND=1.5"},
    {"spindle", "SPOS = 90 M5", "SPOS=90M5"},
    {"polar", "G1 AP = 30 RP = R1", "G1 AP=30 RP=R1"},
    {"thread", "G33 Z-20 K1.5 SF = 90", "G33Z-20K1.5SF=90"},
    {"skip", "/1 G0 X10\n/ M8", "/1G0X10\n/M8"},
    {"comment", "G0 X10 ; to the start", "G0X10; to the start"},
    {"address and value", "G 0 X 10 F 100.5 M 3", "G0X10F100.5M3"},
    {"10", "R01 = 1 R02 = 0. R03 = - 2.5", "R01=1 R02=0. R03=-2.5"},
    // Not taken: known words without a meaning in the IR ...
    {"5", "EXECSTRING ( NAME_1 )", "EXECSTRING(NAME_1)", "EXECSTRING"},
    {"9", "FA [ C ] = 100", "FA[C]=100", "FA"},
    {"10", "R01 = 1 R02 = 0. R03 = - 2.5 L903", "R01=1 R02=0. R03=-2.5 L903", "L903"},
    {"12 $", "R1 = $P_UIFR [ 1 , X , TR ]", "R1=$P_UIFR[1,X,TR]", "TR"},
    {"12 $", "$P_UIFR [ 1 , X , TR ] = 10", "$P_UIFR[1,X,TR]=10", "TR"},
    // ... and text where a reader that guesses moves the machine wrongly.
    {"E is no exponent", "R1 = 1E3", "R1=1E3", "E"},
    {"comment brackets", "G0 X10 ( clear of the part )", "G0X10(clear of the part)", "("},
    {"double equals", "IF R1 = = 1 GOTOF LAB1\nLAB1:", "IF R1 = = 1 GOTOF LAB1\nLAB1:", "="},
};

}  // namespace

std::span<const Form> SinumerikForms() { return kForms; }

}  // namespace ncport::tests
