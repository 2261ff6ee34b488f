; SPDX-License-Identifier: Apache-2.0
; The installer, for makensis: -DVERSION=1.2.3 -DTREE=FOLDER -DFILES=LIST.nsh -DOUT=FILE.exe. It installs TREE, by the
; instructions in FILES, for all users, with an entry of the start menu, and offers pointrt-view for .pro files, which other
; programs have too. /S: without questions; /D=FOLDER, last and without quotation marks: where to.
Target amd64-unicode
Unicode True
SetCompressor /SOLID lzma
SetDateSave off
Name "pointrt ${VERSION}"
OutFile "${OUT}"
Icon "${__FILEDIR__}/pointrt.ico"
UninstallIcon "${__FILEDIR__}/pointrt.ico"
RequestExecutionLevel admin
InstallDir "$PROGRAMFILES64\pointrt"
InstallDirRegKey HKLM "Software\pointrt" ""
ShowInstDetails nevershow

VIProductVersion "${VERSION}.0"
VIAddVersionKey ProductName "pointrt"
VIAddVersionKey FileDescription "Installer of pointrt"
VIAddVersionKey FileVersion "${VERSION}"
VIAddVersionKey LegalCopyright "The pointrt developers"

!define UNINSTALL "Software\Microsoft\Windows\CurrentVersion\Uninstall\pointrt"
!define SCAN "Software\Classes\pointrt.scan"

Page license
Page directory
Page instfiles
UninstPage uninstConfirm
UninstPage instfiles
LicenseData "${TREE}\share\doc\pointrt\LICENSE"

Section
    SetRegView 64
    SetShellVarContext all
    RMDir /r "$INSTDIR\bin" ; of an older version
    RMDir /r "$INSTDIR\share"
    !include "${FILES}"
    SetOutPath "$INSTDIR"
    WriteUninstaller "$INSTDIR\uninstall.exe"
    CreateShortcut "$SMPROGRAMS\pointrt.lnk" "$INSTDIR\bin\pointrt-view.exe"
    WriteRegStr HKLM "Software\pointrt" "" "$INSTDIR"
    WriteRegStr HKLM "${UNINSTALL}" DisplayName "pointrt"
    WriteRegStr HKLM "${UNINSTALL}" DisplayVersion "${VERSION}"
    WriteRegStr HKLM "${UNINSTALL}" UninstallString '"$INSTDIR\uninstall.exe"'
    WriteRegStr HKLM "${SCAN}" "" "Scan of pointrt"
    WriteRegStr HKLM "${SCAN}\shell\open\command" "" '"$INSTDIR\bin\pointrt-view.exe" "%1"'
    WriteRegStr HKLM "Software\Classes\.pro\OpenWithProgids" "pointrt.scan" ""
SectionEnd

Section Uninstall
    SetRegView 64
    SetShellVarContext all
    RMDir /r "$INSTDIR\bin"
    RMDir /r "$INSTDIR\share"
    Delete "$INSTDIR\uninstall.exe"
    RMDir "$INSTDIR" ; stays if it has other files
    Delete "$SMPROGRAMS\pointrt.lnk"
    DeleteRegValue HKLM "Software\Classes\.pro\OpenWithProgids" "pointrt.scan"
    DeleteRegKey HKLM "${SCAN}"
    DeleteRegKey HKLM "${UNINSTALL}"
    DeleteRegKey HKLM "Software\pointrt"
SectionEnd
