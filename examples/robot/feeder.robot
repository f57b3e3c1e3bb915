*** Settings ***
Library           understudy.robot.Understudy
Test Setup        Start Bench    model=simple2-r3
Test Teardown     Close Bench

*** Test Cases ***
A Move Ends Where It Should
    Prepare
    Set Values    Aaxis_Pulse=1000    Aaxis_Move_INC=1
    Run Until    device.STATUS.4 == 0    within=2s
    Value Should Be    Cord_A    1000

Lost Steps Are Noticed
    Prepare
    ${number} =    Inject Fault    lost_steps=A    one_in=50
    Set Values    Aaxis_Pulse=1000    Aaxis_Move_INC=1
    Advance Time    1s
    Expression Should Hold    Cord_A - A.position == 20
    Clear Fault    ${number}

Without Power Nothing Answers
    Send Bytes    01 03 00 01 00 01
    Advance Time    50ms
    Last Frames Should Contain    device.HW_Code = 49153
    Switch Power    off
    Run Keyword And Expect Error    *power*    Get Value    Cord_A

*** Keywords ***
Prepare
    Set Values    Aaxis_SVON=1    Aaxis_Speed=60    Aaxis_AccTime=1    Aaxis_DecTime=1
